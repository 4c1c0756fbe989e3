// Sums light * function * solid angle over one row of a face. One point is drawn for each row, and transform
// feedback writes the sums. The w of each sum is the total solid angle of the texels that were used.
#include "shaders/core/texels.glsl"
#include "shaders/probe/capture/cube.glsl"
#include "shaders/probe/capture/layout.h"

uniform NOOK_TEXELS nook_table;
uniform int nook_limited;        // not 0: luminance is limited to the threshold for suns, which is in the
                                 // first texel
#if NOOK_CAPTURE_KIND == NOOK_CAPTURE_LOBES
uniform int nook_first_lobe;     // the texel of the group's first lobe: axis and sharpness
#endif

#if NOOK_CAPTURE_KIND == NOOK_CAPTURE_LUMINANCE
out vec4 nook_sums[1];
#else
out vec4 nook_sums[NOOK_CAPTURE_GROUP];
#endif

#if NOOK_CAPTURE_KIND == NOOK_CAPTURE_BANDS
void nook_add_bands(vec3 s, vec4 light) {
  nook_sums[0] += NOOK_HARMONICS_0 * light;
  vec4 mixed = NOOK_HARMONICS_2_MIXED * light, linear = NOOK_HARMONICS_1 * light;
  nook_sums[1] += s.y * linear;
  nook_sums[2] += s.z * linear;
  nook_sums[3] += s.x * linear;
  nook_sums[4] += s.x * s.y * mixed;
  nook_sums[5] += s.y * s.z * mixed;
  nook_sums[6] += (NOOK_HARMONICS_2_ZONAL * (3.0 * s.z * s.z - 1.0)) * light;
  nook_sums[7] += s.x * s.z * mixed;
  nook_sums[8] += (NOOK_HARMONICS_2_SQUARES * (s.x * s.x - s.y * s.y)) * light;
}

void nook_add_sun(NookCubeTexel texel, vec3 light) {
  nook_sums[NOOK_CAPTURE_SUN_IRRADIANCE].xyz += light;
  nook_sums[NOOK_CAPTURE_SUN_DIRECTION].xyz += nook_cube_luminance(light) * texel.direction;
  nook_sums[NOOK_CAPTURE_SUN_ANGLE].x += texel.solid_angle;
}
#endif

void main() {
  int face = gl_VertexID / nook_face_size, row = gl_VertexID - face * nook_face_size;
  float limit = nook_limited != 0 ? nook_texel(nook_table, 0).x : 3e38, used = 0.0;
  for (int i = 0; i < nook_sums.length(); ++i) nook_sums[i] = vec4(0.0);
#if NOOK_CAPTURE_KIND == NOOK_CAPTURE_LOBES
  vec4 lobe[NOOK_CAPTURE_GROUP];
  for (int i = 0; i < NOOK_CAPTURE_GROUP; ++i) lobe[i] = nook_texel(nook_table, nook_first_lobe + i);
#endif
  for (int column = 0; column < nook_face_size; ++column) {
    NookCubeTexel texel = nook_cube_texel(face, column, row);
    used += texel.solid_angle;
#if NOOK_CAPTURE_KIND == NOOK_CAPTURE_LUMINANCE
    nook_sums[0].x += texel.solid_angle * min(nook_cube_luminance(texel.radiance), limit);
#else
    vec3 sky = nook_cube_without_sun(texel.radiance, limit), light = texel.solid_angle * sky;
#if NOOK_CAPTURE_KIND == NOOK_CAPTURE_LOBES
    for (int i = 0; i < NOOK_CAPTURE_GROUP; ++i)
      nook_sums[i].xyz += exp(lobe[i].w * (dot(lobe[i].xyz, texel.direction) - 1.0)) * light;
#else
    nook_add_bands(texel.direction, vec4(light, 0.0));
    if (sky != texel.radiance) nook_add_sun(texel, texel.solid_angle * texel.radiance - light);
#endif
#endif
  }
  for (int i = 0; i < nook_sums.length(); ++i) nook_sums[i].w = used;
  gl_Position = vec4(0.0);
}
