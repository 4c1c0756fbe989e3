#ifndef NOOK_TEXELS
// Tables of texels that are fetched by index. On OpenGL, they are texture buffers. OpenGL ES and WebGL do not
// have texture buffers, so there they are 2D textures, which are filled row by row.
#include "shaders/core/texel_layout.h"
#ifdef GL_ES
#define NOOK_TEXELS highp sampler2D
#define nook_texel(table, number) texelFetch(table, ivec2((number) & (NOOK_TEXEL_ROW - 1), (number) >> NOOK_TEXEL_ROW_SHIFT), 0)
#else
#define NOOK_TEXELS samplerBuffer
#define nook_texel(table, number) texelFetch(table, number)
#endif
#endif
