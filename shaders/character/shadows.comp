// The non-linear layer. Computes shadow and added occlusion at the key points of an instance.
#include "shaders/character/key_points.glsl"

layout(std430, binding = NOOK_BINDING_KEY_POINTS) writeonly buffer NookShadows {
  vec2 nook_shadow[];  // shadow, added occlusion
};

float nook_norm_term(vec4 sphere, NookPoint point) {
  vec2 seen = nook_see(sphere, point);
  return nook_raised(nook_shadow_term(seen.x, seen.y), nook_gamma);
}

float nook_norm_sum(uint first, uint count, NookPoint point) {
  float sum = 0.0;
  for (uint begin = 0u; begin < count; begin += nook_tile_size) {
    uint staged = min(count - begin, nook_tile_size);
    nook_stage(first + begin, staged);
    for (uint i = 0u; i < staged; ++i) sum += nook_norm_term(nook_tile[i], point);
  }
  return sum;
}

float nook_depth(uint first, uint count, NookPoint point) {
  float sum = 0.0;
  for (uint begin = 0u; begin < count; begin += nook_tile_size) {
    uint staged = min(count - begin, nook_tile_size);
    nook_stage(first + begin, staged);
    for (uint i = 0u; i < staged; ++i) {
      vec2 seen = nook_see(nook_tile[i], point);
      sum += nook_tile_weight[i] * nook_form_factor_fast(seen.x, seen.y);
    }
  }
  return nook_solid_depth(sum);
}

void main() {
  NookRecord record = nook_read_record(nook_first_record + gl_WorkGroupID.y);
  // Threads beyond the last key point evaluate the last key point again, so that all threads reach every
  // barrier.
  uint key_point = min(gl_GlobalInvocationID.x, nook_key_point_count - 1u);
  NookPoint fitted, surface;
  nook_pose(nook_first_key_point + key_point, record.first_bone, fitted, surface);

  float norm = 0.0, depth = 0.0, open = 1.0;
  if (record.self) norm = nook_norm_sum(record.first_sphere + nook_first_sphere, nook_sphere_count, fitted);
  for (uint c = 0u; c < record.caster_count; ++c) {
    uint at = record.first_caster + uint(NOOK_CASTER_UVEC4S) * c;
    uvec4 caster = nook_stream[at];
    uint spheres = nook_stream[at + 1u].x;
    vec3 offset = uintBitsToFloat(caster.xyz);
    if (nook_composed != 0)
      depth += nook_depth(caster.w, spheres, NookPoint(surface.position - offset, surface.normal));
    else
      norm += nook_norm_sum(caster.w, spheres, NookPoint(fitted.position - offset, fitted.normal));
  }
  for (uint i = 0u; i < record.exact_count; ++i) {
    vec4 sphere = nook_streamed(record.first_exact + i);
    if (nook_composed != 0) {
      vec2 seen = nook_see(sphere, surface);
      open *= 1.0 - min(nook_form_factor_exact(seen.x, seen.y), 1.0);
    } else {
      norm += nook_norm_term(sphere, fitted);
    }
  }
  if (gl_GlobalInvocationID.x < nook_key_point_count)
    nook_shadow[record.place * nook_shadow_stride + nook_shadow_offset + key_point] =
        vec2(nook_shadow_of(norm, key_point), 1.0 - open * exp(-depth));
}
