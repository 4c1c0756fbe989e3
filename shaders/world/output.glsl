// Converts the openness of a pixel to the result: applies intensity and power, combines it with another AO,
// and applies the host's layer.
#include "shaders/nnao/output.glsl"

uniform sampler2D nook_other_ao;
uniform int nook_world_combine;  // 0: there is no other AO; otherwise 1 + nook_world_combine

float nook_world_composed(float ao, ivec2 pixel) {
  if (nook_world_combine == 0) return ao;
  float other = texelFetch(nook_other_ao, pixel + nook_origin, 0).r;
  return nook_world_combine == 1 ? ao * other : min(ao, other);
}

float nook_world_finished(float open, ivec2 pixel) {
  float ao = nook_world_composed(nook_strengthened(open), pixel);
#ifdef NOOK_LAYERED
  ao = nook_combined(ao, pixel);
#endif
  return ao;
}

// open.rgb is the openness in each colour channel. open.a is the open share of the cone of light. The host's
// layer changes open.a only in the modes that replace AO.
vec4 nook_world_result(vec4 open, ivec2 pixel) {
#ifdef NOOK_COLOURED
  vec4 result = vec4(nook_world_finished(open.r, pixel), nook_world_finished(open.g, pixel),
                     nook_world_finished(open.b, pixel), open.a);
#ifdef NOOK_LAYERED
  if (nook_layer_mode >= NOOK_LAYER_REPLACE) result.a = mix(open.a, 1.0, texelFetch(nook_layer, pixel + nook_origin, 0).g);
#endif
  return result;
#else
  return vec4(vec3(nook_world_finished(open.r, pixel)), 1.0);
#endif
}
