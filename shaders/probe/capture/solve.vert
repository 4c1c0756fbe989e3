// Computes the coefficients of a probe from its sums. The output has the layout of the texture that the
// host's shaders read. One point is drawn for each texel.
#include "shaders/core/texels.glsl"
#include "shaders/probe/capture/layout.h"
#include "shaders/probe/constants.h"

uniform NOOK_TEXELS nook_table;
uniform ivec4 nook_sums_map;  // texel of the first sum, number of groups of 12 sums, texel of the map's first row, 0

out vec4 nook_number;

#if NOOK_CAPTURE_FORM == NOOK_CAPTURE_AMPLITUDES
// Multiplies a row of the solution matrix by the sums. A texel of the matrix contains four factors.
vec4 nook_answer() {
  vec3 amplitude = vec3(0.0);
  int quads = 3 * nook_sums_map.y, row = nook_sums_map.z + gl_VertexID * quads;
  for (int i = 0; i < quads; ++i) {
    vec4 factor = nook_texel(nook_table, row + i);
    int sum = nook_sums_map.x + 4 * i;
    amplitude += factor.x * nook_texel(nook_table, sum).xyz + factor.y * nook_texel(nook_table, sum + 1).xyz +
                 factor.z * nook_texel(nook_table, sum + 2).xyz + factor.w * nook_texel(nook_table, sum + 3).xyz;
  }
  return vec4(amplitude, 0.0);
}
#else
// Returns sum i of the last group, which contains the harmonics.
vec3 nook_harmonic(int i) {
  return nook_texel(nook_table, nook_sums_map.x + NOOK_CAPTURE_GROUP * (nook_sums_map.y - 1) + i).xyz;
}

#if NOOK_CAPTURE_FORM == NOOK_CAPTURE_ZONAL
// Returns the part of band 2 that is rotationally symmetric around the axis of band 1's luminance, as in
// harmonics.cpp.
vec3 nook_zonal() {
  vec3 weight = vec3(NOOK_LUMINANCE_RED, NOOK_LUMINANCE_GREEN, NOOK_LUMINANCE_BLUE);
  vec3 axis = vec3(dot(nook_harmonic(3), weight), dot(nook_harmonic(1), weight), dot(nook_harmonic(2), weight));
  float size = length(axis);
  vec3 s = size > 0.0 ? axis / size : vec3(0.0, 0.0, 1.0);
  vec3 sum = NOOK_HARMONICS_2_MIXED * (s.x * s.y * nook_harmonic(4) + s.y * s.z * nook_harmonic(5) + s.x * s.z * nook_harmonic(7)) +
             NOOK_HARMONICS_2_ZONAL * (3.0 * s.z * s.z - 1.0) * nook_harmonic(6) +
             NOOK_HARMONICS_2_SQUARES * (s.x * s.x - s.y * s.y) * nook_harmonic(8);
  return 1.58533092 * sum;  // sqrt(4 pi / 5)
}
#endif

// Returns one value of the result. The channels of all colours form one sequence of values. Each texel
// contains four of them.
float nook_number_at(int at) {
  int colour = at / 3, channel = at - 3 * colour;
#if NOOK_CAPTURE_FORM == NOOK_CAPTURE_ZONAL
  if (colour >= 4) return colour == 4 ? nook_zonal()[channel] : 0.0;
#endif
  return colour < 9 ? nook_harmonic(colour)[channel] : 0.0;
}

// The result is clamped to 65504, the maximum of a half float.
vec4 nook_answer() {
  int first = 4 * gl_VertexID;
  return clamp(vec4(nook_number_at(first), nook_number_at(first + 1), nook_number_at(first + 2), nook_number_at(first + 3)),
               -65504.0, 65504.0);
}
#endif

void main() {
  nook_number = nook_answer();
  gl_Position = vec4(0.0);
}
