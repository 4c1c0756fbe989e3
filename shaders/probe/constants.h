// Constants of the formulas that sdk/src/probe (harmonics.h, zonal_harmonics.cpp, ggx_reflection.cpp) and
// these shaders share. C++ and GLSL both include this file.
#ifndef NOOK_PROBE_CONSTANTS_H
#define NOOK_PROBE_CONSTANTS_H

// Real spherical harmonics, orthonormal: the factors of 1; of y, z, x; of xy, yz, xz; of 3zz - 1; of xx - yy.
#define NOOK_HARMONICS_0 0.28209479177387814
#define NOOK_HARMONICS_1 0.4886025119029199
#define NOOK_HARMONICS_2_MIXED 1.0925484305920792
#define NOOK_HARMONICS_2_ZONAL 0.31539156525252005
#define NOOK_HARMONICS_2_SQUARES 0.5462742152960396

// Luminance of linear RGB with the primaries of Rec. 709.
#define NOOK_LUMINANCE_RED 0.2126
#define NOOK_LUMINANCE_GREEN 0.7152
#define NOOK_LUMINANCE_BLUE 0.0722

// Grids in 3D textures: walls of a cell are planes, which cut it into sides; what a share of a place between
// two probes is away from 0 and 1, so that probes on one's own side keep their proportions where others have
// all the weight.
#define NOOK_GRID_PLANES 3
#define NOOK_GRID_SIDES 8
#define NOOK_GRID_LEAST_SHARE 0.00390625
// Texels of a probe: bands 0 to 2, and ZH3. Those of a cell: its planes, and the masks of four sides each.
#define NOOK_GRID_HARMONICS_TEXELS 7
#define NOOK_GRID_ZONAL_TEXELS 4
#define NOOK_GRID_WALL_TEXELS 5

// GGX reflection: polynomials of two variables, sums of k u^i v^j over i + j <= degree, j fastest.
// tests/probe/ggx_fit.cpp fits them.
#define NOOK_GGX_ALBEDO_0 0.944055
#define NOOK_GGX_ALBEDO_1 -0.13538
#define NOOK_GGX_ALBEDO_2 -0.571832
#define NOOK_GGX_ALBEDO_3 0.749777
#define NOOK_GGX_ALBEDO_4 -0.360353
#define NOOK_GGX_ALBEDO_5 -0.0303299
#define NOOK_GGX_ALBEDO_6 0.485681
#define NOOK_GGX_ALBEDO_7 -2.26075
#define NOOK_GGX_ALBEDO_8 0.96185
#define NOOK_GGX_ALBEDO_9 -0.134767
#define NOOK_GGX_ALBEDO_10 0.886719
#define NOOK_GGX_ALBEDO_11 0.706674
#define NOOK_GGX_ALBEDO_12 -0.411119
#define NOOK_GGX_ALBEDO_13 -1.14826
#define NOOK_GGX_ALBEDO_14 0.620676
#define NOOK_GGX_FRESNEL_0 0.108191
#define NOOK_GGX_FRESNEL_1 2.83018
#define NOOK_GGX_FRESNEL_2 -4.61656
#define NOOK_GGX_FRESNEL_3 2.03889
#define NOOK_GGX_FRESNEL_4 0.108505
#define NOOK_GGX_FRESNEL_5 -1.35554
#define NOOK_GGX_FRESNEL_6 0.268952
#define NOOK_GGX_FRESNEL_7 6.32566
#define NOOK_GGX_FRESNEL_8 -4.83581
#define NOOK_GGX_FRESNEL_9 0.906918
#define NOOK_GGX_FRESNEL_10 -7.91908
#define NOOK_GGX_FRESNEL_11 4.70353
#define NOOK_GGX_FRESNEL_12 2.07866
#define NOOK_GGX_FRESNEL_13 0.151807
#define NOOK_GGX_FRESNEL_14 -1.00017
#define NOOK_GGX_TILT_0 0.110059
#define NOOK_GGX_TILT_1 -0.14709
#define NOOK_GGX_TILT_2 1.09911
#define NOOK_GGX_TILT_3 0.00187069
#define NOOK_GGX_TILT_4 -0.124211
#define NOOK_GGX_TILT_5 -0.105623
#define NOOK_GGX_WIDTH_0 4.75539
#define NOOK_GGX_WIDTH_1 -8.25312
#define NOOK_GGX_WIDTH_2 3.73913
#define NOOK_GGX_WIDTH_3 -0.619576
#define NOOK_GGX_WIDTH_4 0.570814
#define NOOK_GGX_WIDTH_5 0.0648816
#define NOOK_GGX_WIDER_0 2.23813
#define NOOK_GGX_WIDER_1 -2.03077
#define NOOK_GGX_WIDER_2 -0.103893
#endif
