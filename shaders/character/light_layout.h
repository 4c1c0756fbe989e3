// Says where the texels of an instance's light are in the texture of all lights. C++ and GLSL both include
// this file.
#ifndef NOOK_CHARACTER_LIGHT_LAYOUT_H
#define NOOK_CHARACTER_LIGHT_LAYOUT_H

// An instance's light begins with the number of lobes and the ground's normal. Then come the darkest mean
// radiance, with 1 if there is a ground, and ten texels of the light's bands. Each lobe has two: axis and
// sharpness, then amplitude and the share that the ground leaves.
#define NOOK_LIGHT_HEAD 0
#define NOOK_LIGHT_DARKEST 1
#define NOOK_LIGHT_SCALAR 2
#define NOOK_LIGHT_VECTOR 3
#define NOOK_LIGHT_STRAIGHT 6
#define NOOK_LIGHT_MIXED 9
#define NOOK_LIGHT_LOBES 12
#define NOOK_LIGHT_LOBE_TEXELS 2

#endif
