// The layout that the shaders of captures and sdk/src/gl/probe/capture.h share: how sums over a cube
// map lie in the table of texels. C++ and GLSL both include this file.
#ifndef NOOK_PROBE_CAPTURE_LAYOUT_H
#define NOOK_PROBE_CAPTURE_LAYOUT_H

// Sums that one draw gathers: at most 12 vec4, because transform feedback captures 64 numbers of a vertex.
// A group is 12 lobes, or the harmonics of bands 0 to 2 and what suns take away.
#define NOOK_CAPTURE_GROUP 12
// In the group of harmonics, after nine of these: the suns' irradiance, their direction times luminance, and
// their solid angle.
#define NOOK_CAPTURE_SUN_IRRADIANCE 9
#define NOOK_CAPTURE_SUN_DIRECTION 10
#define NOOK_CAPTURE_SUN_ANGLE 11

// The kinds of sums over texels; that of luminance has one.
#define NOOK_CAPTURE_LOBES 0
#define NOOK_CAPTURE_BANDS 1
#define NOOK_CAPTURE_LUMINANCE 2

// The forms of a result: amplitudes of lobes, texels of a grid of harmonics, or those of ZH3.
#define NOOK_CAPTURE_AMPLITUDES 0
#define NOOK_CAPTURE_HARMONICS 1
#define NOOK_CAPTURE_ZONAL 2

#define NOOK_CAPTURE_UNIT_TABLE 0
#define NOOK_CAPTURE_UNIT_CUBE 1

#endif
