// The row length of the 2D textures that replace texture buffers on OpenGL ES. Both C++ and GLSL include this
// file.
#ifndef NOOK_CORE_TEXEL_LAYOUT_H
#define NOOK_CORE_TEXEL_LAYOUT_H

// The row length is 2 to the power of this shift. Every OpenGL ES 3.0 supports textures of 2048 x 2048.
#define NOOK_TEXEL_ROW_SHIFT 11
#define NOOK_TEXEL_ROW 2048

#endif
