// The layout of the sums over a cube map in the table of texels. The shaders of captures share it with
// sdk/src/gl/probe/capture.h. C++ and GLSL both include this file.
#ifndef NOOK_PROBE_CAPTURE_LAYOUT_H
#define NOOK_PROBE_CAPTURE_LAYOUT_H

// One draw computes a group of at most 12 vec4, because transform feedback is limited to 64 components per
// vertex. A group is either 12 lobes, or the harmonics of bands 0 to 2 and the sums for suns.
#define NOOK_CAPTURE_GROUP 12
// In the group of harmonics, the nine harmonics are followed by three sums for suns: their irradiance, their
// direction times luminance, and their solid angle.
#define NOOK_CAPTURE_SUN_IRRADIANCE 9
#define NOOK_CAPTURE_SUN_DIRECTION 10
#define NOOK_CAPTURE_SUN_ANGLE 11

// The kinds of sums over texels. NOOK_CAPTURE_LUMINANCE is a single sum.
#define NOOK_CAPTURE_LOBES 0
#define NOOK_CAPTURE_BANDS 1
#define NOOK_CAPTURE_LUMINANCE 2

// A result is either amplitudes of lobes, or texels of a grid with harmonics or with ZH3.
#define NOOK_CAPTURE_AMPLITUDES 0
#define NOOK_CAPTURE_HARMONICS 1
#define NOOK_CAPTURE_ZONAL 2

#define NOOK_CAPTURE_UNIT_TABLE 0
#define NOOK_CAPTURE_UNIT_CUBE 1

#endif
