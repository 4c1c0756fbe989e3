#ifndef NOOK_TEXELS
// Tables of texels that are fetched by number. They are texture buffers on OpenGL. OpenGL ES and WebGL lack
// those and have 2D textures, whose rows follow one another.
#include "shaders/core/texel_layout.h"
#ifdef GL_ES
#define NOOK_TEXELS highp sampler2D
#define nook_texel(table, number) texelFetch(table, ivec2((number) & (NOOK_TEXEL_ROW - 1), (number) >> NOOK_TEXEL_ROW_SHIFT), 0)
#else
#define NOOK_TEXELS samplerBuffer
#define nook_texel(table, number) texelFetch(table, number)
#endif
#endif
