// Constants of formulas in sdk/src/probe (harmonics.h, harmonics.cpp, ggx_reflection.cpp) and in these
// shaders. C++ and GLSL both include this file.
#ifndef NOOK_PROBE_CONSTANTS_H
#define NOOK_PROBE_CONSTANTS_H

// Factors that make real spherical harmonics orthonormal. In this order, they multiply 1; y, z and x; xy, yz
// and xz; 3zz - 1; and xx - yy.
#define NOOK_HARMONICS_0 0.28209479177387814
#define NOOK_HARMONICS_1 0.4886025119029199
#define NOOK_HARMONICS_2_MIXED 1.0925484305920792
#define NOOK_HARMONICS_2_ZONAL 0.31539156525252005
#define NOOK_HARMONICS_2_SQUARES 0.5462742152960396

// Luminance weights of linear RGB with the primaries of Rec. 709.
#define NOOK_LUMINANCE_RED 0.2126
#define NOOK_LUMINANCE_GREEN 0.7152
#define NOOK_LUMINANCE_BLUE 0.0722

// Grids in 3D textures. The walls of a cell are planes that cut the cell into sides. Interpolation factors
// are clamped to at least NOOK_GRID_LEAST_SHARE and at most 1 - NOOK_GRID_LEAST_SHARE. Without this,
// trilinear interpolation could give all weight to probes on other sides of a wall. With it, the probes on
// the point's own side always have weights above 0, in the right proportions.
#define NOOK_GRID_PLANES 3
#define NOOK_GRID_SIDES 8
#define NOOK_GRID_LEAST_SHARE 0.00390625
// A probe takes NOOK_GRID_HARMONICS_TEXELS texels with bands 0 to 2, and NOOK_GRID_ZONAL_TEXELS texels with
// ZH3. A cell also has texels for its planes, and texels for the masks of its sides, four masks in each.
#define NOOK_GRID_HARMONICS_TEXELS 7
#define NOOK_GRID_ZONAL_TEXELS 4
#define NOOK_GRID_WALL_TEXELS 5

// GGX reflection: coefficients of polynomials of two variables. A polynomial is the sum of k u^i v^j over i +
// j <= degree, where j varies fastest. tests/probe/ggx_fit.cpp fits the coefficients.
#define NOOK_GGX_ALBEDO_0 1.02286, -0.143031, 0.0444111, 0.284177, -0.255489
#define NOOK_GGX_ALBEDO_1 -0.30345, -0.137175, -2.94936, 1.20419, 0.634343
#define NOOK_GGX_ALBEDO_2 2.18437, 0.950226, -1.52654, -1.87658, 1.17025
#define NOOK_GGX_FRESNEL_0 0.0959894, 2.7088, -4.49875, 2.04796, 0.0822377
#define NOOK_GGX_FRESNEL_1 -1.19048, 0.453772, 5.69707, -4.60221, 0.51734
#define NOOK_GGX_FRESNEL_2 -7.41744, 4.8863, 2.22828, -0.318929, -0.891444
// A few visible normals represent all visible normals. For a single lobe, there is one normal. For four
// lobes, there is one normal towards the eye, one away from the eye, and one on each side. Each normal has a
// place on the disc, a share of the disc, and a sharpness divided by the density of directions.
#define NOOK_GGX_MIDDLE_ALONG -0.629765, 1.84005, -0.724038, 0.327629, -0.673784, -0.0885385
#define NOOK_GGX_MIDDLE_SHARPNESS 1.38497, -3.91715, 4.77755, -1.724, 2.54411, 0.661453
#define NOOK_GGX_NEAR_ALONG -0.837711, 0.119602, 0.228392, -0.168367, 0.227789, 0.034692
#define NOOK_GGX_NEAR_SHARE 2.44044, -2.32376, 0.00182283, -3.09809, 3.01962, 0.971028
#define NOOK_GGX_NEAR_SHARPNESS -1.44512, -11.1609, 31.6031, 54.6426, -7.68545, -49.4852
#define NOOK_GGX_FAR_ALONG 0.100369, 0.939853, -0.0907857, 0.88269, -1.4198, -0.187383
#define NOOK_GGX_FAR_SHARE 6.35685, -8.90725, 3.09028, -5.27449, 6.63245, 0.929656
#define NOOK_GGX_FAR_SHARPNESS 3.55545, -11.3527, 13.2198, 4.77483, 0.292011, -4.02235
#define NOOK_GGX_PAIR_ACROSS 0.628419, -0.124173, -0.0581845, -0.223009, -0.0456595, 0.219232
#define NOOK_GGX_PAIR_ALONG -0.690812, 1.28299, -0.527067, 0.167992, -0.257236, -0.0667501
#define NOOK_GGX_PAIR_SHARPNESS 37.2129, -77.3216, 44.8479, -17.9731, 28.8916, -1.68191
#endif
