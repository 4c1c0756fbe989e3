// The row length of the 2D textures that replace texture buffers on OpenGL ES. C++ and GLSL both include this
// file.
#ifndef NOOK_CORE_TEXEL_LAYOUT_H
#define NOOK_CORE_TEXEL_LAYOUT_H

// 2 to the power of the shift; every OpenGL ES 3.0 has textures of 2048 x 2048.
#define NOOK_TEXEL_ROW_SHIFT 11
#define NOOK_TEXEL_ROW 2048

#endif
