#ifndef NOOK_PROBE_BASIS_SH
#define NOOK_PROBE_BASIS_SH
// Light as real orthonormal spherical harmonics without the Condon-Shortley phase. nook_sg_to_sh and fits of
// NOOK_PROBE_BASIS_SH write the coefficients in this form. The order is 1, then y, z, x, then xy, yz, 3zz - 1,
// xz, xx - yy. Directions are unit vectors.

#include "shaders/probe/constants.h"

// Bands 0 to 2, with nine coefficients. In std140 and std430, NookHarmonics has the layout of 9 vec4.
struct NookHarmonics {
  vec3 coefficient[9];
};

// Bands 0 and 1, and the part of band 2 that is rotationally symmetric around the axis of band 1's luminance
// (T. Roughton, P.-P. Sloan, A. Silvennoinen, M. Iwanicki, P. Shirley, ZH3: Quadratic Zonal Harmonics, 2024).
// This form takes 15 floats instead of 27.
struct NookZonalHarmonics {
  vec3 coefficient[4];
  vec3 zonal;
};

// Sums the harmonics in a direction, with one factor for each band. For radiance the factors are 1; for
// irradiance they are the factors of the clamped cosine.
vec3 nook_sh_linear(vec3 c0, vec3 c1, vec3 c2, vec3 c3, vec3 s, vec2 factor) {
  return factor.x * NOOK_HARMONICS_0 * c0 + factor.y * NOOK_HARMONICS_1 * (s.y * c1 + s.z * c2 + s.x * c3);
}

vec3 nook_sh_sum(NookHarmonics light, vec3 s, vec3 factor) {
  vec3 sum = nook_sh_linear(light.coefficient[0], light.coefficient[1], light.coefficient[2],
                                         light.coefficient[3], s, factor.xy);
  vec3 band2 = NOOK_HARMONICS_2_MIXED * (s.x * s.y * light.coefficient[4] + s.y * s.z * light.coefficient[5] +
                             s.x * s.z * light.coefficient[7]) +
               NOOK_HARMONICS_2_ZONAL * (3.0 * s.z * s.z - 1.0) * light.coefficient[6] +
               NOOK_HARMONICS_2_SQUARES * (s.x * s.x - s.y * s.y) * light.coefficient[8];
  return sum + factor.z * band2;
}

vec3 nook_zh3_sum(NookZonalHarmonics light, vec3 s, vec3 factor) {
  vec3 sum = nook_sh_linear(light.coefficient[0], light.coefficient[1], light.coefficient[2],
                                         light.coefficient[3], s, factor.xy);
  const vec3 luminance = vec3(NOOK_LUMINANCE_RED, NOOK_LUMINANCE_GREEN, NOOK_LUMINANCE_BLUE);
  vec3 axis = vec3(dot(light.coefficient[3], luminance), dot(light.coefficient[1], luminance),
                   dot(light.coefficient[2], luminance));
  float size = length(axis);
  float cosine = size > 0.0 ? dot(axis, s) / size : s.z;
  return sum + factor.z * NOOK_HARMONICS_2_ZONAL * (3.0 * cosine * cosine - 1.0) * light.zonal;
}

// Returns the radiance from a direction.
vec3 nook_sh_radiance(NookHarmonics light, vec3 s) {
  return nook_sh_sum(light, s, vec3(1.0));
}
vec3 nook_zh3_radiance(NookZonalHarmonics light, vec3 s) {
  return nook_zh3_sum(light, s, vec3(1.0));
}

// Returns the irradiance on a surface, which is exact for these bands. On the side opposite to a sun, ringing
// can make it negative. Negative values are clamped to 0.
vec3 nook_sh_irradiance(NookHarmonics light, vec3 n) {
  return max(nook_sh_sum(light, n, vec3(3.14159265, 2.09439510, 0.78539816)), 0.0);
}
vec3 nook_zh3_irradiance(NookZonalHarmonics light, vec3 n) {
  return max(nook_zh3_sum(light, n, vec3(3.14159265, 2.09439510, 0.78539816)), 0.0);
}
#endif
