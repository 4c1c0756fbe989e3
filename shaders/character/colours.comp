// Computes directional occlusion at the key points of instances that have a light: the colour of the shadow,
// and the added occlusion of each channel.
#include "shaders/core/constants.h"
#include "shaders/character/key_points.glsl"
#include "shaders/character/light.glsl"

layout(std430, binding = NOOK_BINDING_KEY_POINTS) writeonly buffer NookColours {
  vec4 nook_colour[];  // two for each key point: (colour that multiplies the shadow, shadow), then the
                       // added occlusion of each channel
};

void nook_gather_sphere(inout NookBands bands, vec4 sphere, NookPoint point) {
  vec3 o = (sphere.xyz - point.position) * sphere.w;
  float y = nook_shadow_term(dot(o, point.normal), dot(o, o));
  NookSight sight = nook_sight(point.normal, o);
  float k = nook_concentration(sight, max(y, NOOK_SMALLEST_SHARE), NOOK_SELF_CONCENTRATION);
  nook_gather(bands, point.normal * NOOK_COSINE_LOBE_SHARPNESS + sight.towards * k, nook_raised(y, nook_gamma));
}

NookBands nook_no_bands() { return NookBands(0.0, vec3(0.0), vec3(0.0), vec3(0.0)); }

NookBands nook_gather_spheres(uint first, uint count, NookPoint point) {
  NookBands bands = nook_no_bands();
  for (uint begin = 0u; begin < count; begin += nook_tile_size) {
    uint staged = min(count - begin, nook_tile_size);
    nook_stage(first + begin, staged);
    for (uint i = 0u; i < staged; ++i) nook_gather_sphere(bands, nook_tile[i], point);
  }
  return bands;
}

// Combines the spheres of a caster. xyz is the sum of the directions to the spheres, weighted by the shares
// of the hemisphere that they cover. w is the sum of these shares.
vec4 nook_joint_sight(uint first, uint count, NookPoint point) {
  vec4 joint = vec4(0.0);
  for (uint begin = 0u; begin < count; begin += nook_tile_size) {
    uint staged = min(count - begin, nook_tile_size);
    nook_stage(first + begin, staged);
    for (uint i = 0u; i < staged; ++i) {
      vec3 o = (nook_tile[i].xyz - point.position) * nook_tile[i].w;
      float takes = nook_tile_weight[i] * nook_form_factor_fast(dot(o, point.normal), dot(o, o));
      joint += vec4(nook_sight(point.normal, o).towards, 1.0) * takes;
    }
  }
  return joint;
}

vec3 nook_depth(uint light, vec3 inverse, vec3 n, vec4 joint) {
  float squared = dot(joint.xyz, joint.xyz);
  vec3 d = joint.xyz * inversesqrt(max(squared, 1e-30));
  float sharpest = 1.0 / max(1.0 - sqrt(squared) / max(joint.w, 1e-15), 1e-4);
  return nook_solid_depth(joint.w) *
         nook_light_ratio(light, inverse, n, NookSight(d, dot(d, n)), min(joint.w, 1.0), sharpest);
}

vec3 nook_left(vec3 open, float share, vec3 ratio) { return open * (1.0 - min(share * ratio, 1.0)); }

void main() {
  NookRecord record = nook_read_record(nook_first_record + gl_WorkGroupID.y);
  // All threads of a group belong to one instance.
  if (record.light == 0u) return;
  uint light = record.light;
  uint key_point = min(gl_GlobalInvocationID.x, nook_key_point_count - 1u);
  NookPoint fitted, surface;
  nook_pose(nook_first_key_point + key_point, record.first_bone, fitted, surface);

  float norm = 0.0;
  vec3 coloured = vec3(0.0), depth = vec3(0.0), open = vec3(1.0);
  if (record.self) {
    NookBands own = nook_gather_spheres(record.first_sphere + nook_first_sphere, nook_sphere_count, fitted);
    norm = own.scalar;
    coloured = nook_coloured_sum(light, own, fitted.normal);
  }
  vec3 inverse = nook_inverse_hemisphere(light, surface.normal);
  for (uint c = 0u; c < record.caster_count; ++c) {
    uint at = record.first_caster + uint(NOOK_CASTER_UVEC4S) * c;
    uvec4 caster = nook_stream[at];
    uint spheres = nook_stream[at + 1u].x;
    vec3 offset = uintBitsToFloat(caster.xyz);
    if (nook_composed != 0) {
      NookPoint point = NookPoint(surface.position - offset, surface.normal);
      depth += nook_depth(light, inverse, surface.normal, nook_joint_sight(caster.w, spheres, point));
    } else {
      NookBands others = nook_gather_spheres(caster.w, spheres, NookPoint(fitted.position - offset, fitted.normal));
      norm += others.scalar;
      coloured += nook_coloured_sum(light, others, fitted.normal);
    }
  }
  uint grounds = uint(nook_light(light, NOOK_LIGHT_DARKEST).w);  // 1 if the first of the exact spheres is the
                                                                 // ground, else 0
  NookBands ground = nook_no_bands(), free = nook_no_bands();
  for (uint i = 0u; i < record.exact_count; ++i) {
    vec4 sphere = nook_streamed(record.first_exact + i);
    vec3 o = (sphere.xyz - surface.position) * sphere.w;
    float share = min(nook_form_factor_exact(dot(o, surface.normal), dot(o, o)), 1.0);
    if (nook_composed == 0) {
      if (i < grounds)
        nook_gather_sphere(ground, sphere, fitted);
      else
        nook_gather_sphere(free, sphere, fitted);
    } else if (i < grounds) {
      open = nook_left(open, share, nook_ground_ratio(light, surface.normal));
    } else {
      NookSight sight = nook_sight(surface.normal, o);
      open = nook_left(open, share, nook_light_ratio(light, inverse, surface.normal, sight, share, NOOK_NO_SHARPEST));
    }
  }
  if (nook_composed == 0) {
    norm += ground.scalar + free.scalar;
    coloured += nook_coloured_sum(light, ground, fitted.normal) + nook_coloured_sum(light, free, fitted.normal);
  }
  if (gl_GlobalInvocationID.x < nook_key_point_count) {
    uint place = uint(NOOK_COLOUR_VEC4S) * (record.place * nook_shadow_stride + nook_shadow_offset + key_point);
    nook_colour[place] = vec4(norm > 0.0 ? coloured / norm : vec3(1.0), nook_shadow_of(norm, key_point));
    nook_colour[place + 1u] = vec4(1.0 - open * exp(-depth), 0.0);
  }
}
