#ifndef NOOK_TEXELS
// Tables of texels that are fetched by number: texture buffers on OpenGL; 2D textures on OpenGL ES and WebGL, which lack
// texture buffers, with their rows one after another.
#include "shaders/core/texel_layout.h"
#ifdef GL_ES
#define NOOK_TEXELS highp sampler2D
#define nook_texel(table, number) texelFetch(table, ivec2((number) & (NOOK_TEXEL_ROW - 1), (number) >> NOOK_TEXEL_ROW_SHIFT), 0)
#else
#define NOOK_TEXELS samplerBuffer
#define nook_texel(table, number) texelFetch(table, number)
#endif
#endif
