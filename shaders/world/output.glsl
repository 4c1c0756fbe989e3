// From the openness of a pixel to the result: strength, the composition with AO of another kind, the layer.

uniform sampler2D nook_other_ao;
uniform int nook_world_combine;  // 0: there is no other AO; otherwise 1 + nook_world_combine
#ifdef NOOK_LAYERED
uniform sampler2D nook_layer;
#endif

float nook_world_strengthened(float ao) {
  float base = max(1.0 - nook_intensity * (1.0 - ao), 0.0);
  // pow is inexact on some drivers, and open must stay exactly open.
  return nook_power == 1.0 || base == 1.0 ? base : pow(base, nook_power);
}

float nook_world_composed(float ao, ivec2 pixel) {
  if (nook_world_combine == 0) return ao;
  float other = texelFetch(nook_other_ao, pixel + nook_origin, 0).r;
  return nook_world_combine == 1 ? ao * other : min(ao, other);
}

#ifdef NOOK_LAYERED
// The modes of nook_gbuffer_ao.
float nook_world_combined(float ao, ivec2 pixel) {
  vec2 layer = texelFetch(nook_layer, pixel + nook_origin, 0).rg;
  if (nook_layer_mode >= 3) return mix(ao, layer.r, layer.g);
  float smaller = min(ao, layer.r);
  return nook_layer_mode == 1 ? smaller : layer.r > 0.0 ? smaller / layer.r : 1.0;
}
#endif

float nook_world_finished(float open, ivec2 pixel) {
  float ao = nook_world_composed(nook_world_strengthened(open), pixel);
#ifdef NOOK_LAYERED
  ao = nook_world_combined(ao, pixel);
#endif
  return ao;
}

// open: by channel, and of the cone of light, which the replacing layers alone change.
vec4 nook_world_result(vec4 open, ivec2 pixel) {
#ifdef NOOK_COLOURED
  vec4 result = vec4(nook_world_finished(open.r, pixel), nook_world_finished(open.g, pixel),
                     nook_world_finished(open.b, pixel), open.a);
#ifdef NOOK_LAYERED
  if (nook_layer_mode >= 3) result.a = mix(open.a, 1.0, texelFetch(nook_layer, pixel + nook_origin, 0).g);
#endif
  return result;
#else
  return vec4(vec3(nook_world_finished(open.r, pixel)), 1.0);
#endif
}
