// Defines the layout of an instance's light in the texture of all lights. Both C++ and GLSL include this
// file.
#ifndef NOOK_CHARACTER_LIGHT_LAYOUT_H
#define NOOK_CHARACTER_LIGHT_LAYOUT_H

// The first texel of a light contains the number of lobes and the ground's normal. The second contains the
// lower bound of the mean radiance, and 1 if there is a ground. Then come ten texels with the light's bands.
// Then come two texels for each lobe. One contains axis and sharpness, the other the amplitude and the share
// of the lobe that the ground does not hide.
#define NOOK_LIGHT_HEAD 0
#define NOOK_LIGHT_DARKEST 1
#define NOOK_LIGHT_SCALAR 2
#define NOOK_LIGHT_VECTOR 3
#define NOOK_LIGHT_STRAIGHT 6
#define NOOK_LIGHT_MIXED 9
#define NOOK_LIGHT_LOBES 12
#define NOOK_LIGHT_LOBE_TEXELS 2

#endif
