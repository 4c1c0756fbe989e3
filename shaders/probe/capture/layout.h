// The layout of sums over a cube map in the table of texels, which the shaders of captures share with
// sdk/src/gl/probe/capture.h. C++ and GLSL both include this file.
#ifndef NOOK_PROBE_CAPTURE_LAYOUT_H
#define NOOK_PROBE_CAPTURE_LAYOUT_H

// One draw gathers at most 12 vec4, because transform feedback captures 64 numbers of a vertex. A group is 12
// lobes, or the harmonics of bands 0 to 2 and what suns take away.
#define NOOK_CAPTURE_GROUP 12
// After nine harmonics, their group has the suns' irradiance, their direction times luminance, and their
// solid angle.
#define NOOK_CAPTURE_SUN_IRRADIANCE 9
#define NOOK_CAPTURE_SUN_DIRECTION 10
#define NOOK_CAPTURE_SUN_ANGLE 11

// The kinds of sums over texels; luminance has a single sum.
#define NOOK_CAPTURE_LOBES 0
#define NOOK_CAPTURE_BANDS 1
#define NOOK_CAPTURE_LUMINANCE 2

// The forms of a result: amplitudes of lobes, or texels of a grid of harmonics or of ZH3.
#define NOOK_CAPTURE_AMPLITUDES 0
#define NOOK_CAPTURE_HARMONICS 1
#define NOOK_CAPTURE_ZONAL 2

#define NOOK_CAPTURE_UNIT_TABLE 0
#define NOOK_CAPTURE_UNIT_CUBE 1

#endif
