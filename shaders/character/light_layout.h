// Where the texels of an instance's light lie in the texture of all lights. C++ and GLSL both include this
// file.
#ifndef NOOK_CHARACTER_LIGHT_LAYOUT_H
#define NOOK_CHARACTER_LIGHT_LAYOUT_H

// Texels of an instance's light: number of lobes and the ground's normal; the darkest mean radiance and 1
// with a ground; ten of the light's bands; then two for each lobe: axis and sharpness, amplitude and the
// share that the ground leaves.
#define NOOK_LIGHT_HEAD 0
#define NOOK_LIGHT_DARKEST 1
#define NOOK_LIGHT_SCALAR 2
#define NOOK_LIGHT_VECTOR 3
#define NOOK_LIGHT_STRAIGHT 6
#define NOOK_LIGHT_MIXED 9
#define NOOK_LIGHT_LOBES 12
#define NOOK_LIGHT_LOBE_TEXELS 2

#endif
