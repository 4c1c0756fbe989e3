// The horizon form; network.h defines it. Eight units are two vec4.
uniform vec4 nook_network[81];  // tap, direction, join, out, in the order of network.h
// Directions. Not a constant: compilers would unroll them all, into more code than caches hold.
uniform int nook_tap_groups;

// Where each layer begins, and its bias, of two vec4, after which negative and positive slopes follow.
const int nook_tap_layer = 0, nook_tap_bias = 6;
const int nook_direction_layer = 12, nook_direction_bias = 48;
const int nook_join_layer = 54, nook_join_bias = 72;
const int nook_out_layer = 78;

struct nook_units {
  vec4 low, high;
};

void nook_add(inout nook_units sum, float x, int weights) {
  sum.low += x * nook_network[weights];
  sum.high += x * nook_network[weights + 1];
}

void nook_add(inout nook_units sum, vec4 x, int weights) {
  nook_add(sum, x.x, weights);
  nook_add(sum, x.y, weights + 2);
  nook_add(sum, x.z, weights + 4);
  nook_add(sum, x.w, weights + 6);
}

nook_units nook_bias(int bias) {
  return nook_units(nook_network[bias], nook_network[bias + 1]);
}

nook_units nook_prelu(nook_units x, int bias) {
  return nook_units(max(x.low, 0.0) * nook_network[bias + 4] + min(x.low, 0.0) * nook_network[bias + 2],
                    max(x.high, 0.0) * nook_network[bias + 5] + min(x.high, 0.0) * nook_network[bias + 3]);
}

// The hidden units of one tap, 0 where there is no surface within two radii.
nook_units nook_tap_units(ivec2 at, vec3 position, vec3 normal, vec3 viewer, float radius) {
  nook_units none = nook_units(vec4(0.0), vec4(0.0));
  float depth = nook_surface_depth(at);
  if (depth == nook_no_surface) return none;
  vec3 v = nook_position(nook_surface_rays, at, depth) - position;
  float away = length(v), distance_r = away / radius;
  if (!(distance_r < 2.0) || !(away > 0.0)) return none;
  nook_units x = nook_bias(nook_tap_bias);
  nook_add(x, dot(v, normal) / away, nook_tap_layer);
  nook_add(x, dot(v, viewer) / away, nook_tap_layer + 2);
  nook_add(x, distance_r, nook_tap_layer + 4);
  x = nook_prelu(x, nook_tap_bias);
  float weight = min(2.0 - distance_r, 1.0);
  return nook_units(x.low * weight, x.high * weight);
}

nook_units nook_direction_units(ivec2 texel, vec2 direction, vec2 noise, vec3 position, vec3 normal, vec3 viewer,
                                vec2 scale, vec2 radius) {
  nook_units most = nook_units(vec4(-nook_no_surface), vec4(-nook_no_surface));
  nook_units sum = nook_units(vec4(0.0), vec4(0.0));
  for (int i = 0; i < NOOK_STEPS; ++i) {
    float distance_px = nook_step_distance(i, NOOK_STEPS, noise, radius.y);
    ivec2 at = nook_tapped_texel(texel, nook_horizon_tap(direction, distance_px, scale));
    nook_units hidden = nook_tap_units(at, position, normal, viewer, radius.x);
    most = nook_units(max(most.low, hidden.low), max(most.high, hidden.high));
    sum = nook_units(sum.low + hidden.low, sum.high + hidden.high);
  }
  vec3 along = vec3(direction, 0.0);
  vec3 across = normalize(along - dot(along, viewer) * viewer);
  nook_units x = nook_bias(nook_direction_bias);
  nook_add(x, most.low, nook_direction_layer);
  nook_add(x, most.high, nook_direction_layer + 8);
  nook_add(x, sum.low / float(NOOK_STEPS), nook_direction_layer + 16);
  nook_add(x, sum.high / float(NOOK_STEPS), nook_direction_layer + 24);
  nook_add(x, dot(normal, across), nook_direction_layer + 32);
  nook_add(x, dot(normal, viewer), nook_direction_layer + 34);
  return nook_prelu(x, nook_direction_bias);
}

float nook_evaluate(ivec2 texel, vec3 position, vec3 normal, vec2 scale, vec2 radius) {
  vec2 noise = nook_tap_noise(texel);
  vec3 viewer = nook_to_viewer(position);
  nook_units sum = nook_units(vec4(0.0), vec4(0.0));
  for (int i = 0; i < nook_tap_groups; ++i) {
    float angle = nook_direction_angle(i, nook_tap_groups, noise);
    nook_units x = nook_direction_units(texel, vec2(cos(angle), sin(angle)), noise, position, normal, viewer, scale,
                                        radius);
    sum = nook_units(sum.low + x.low, sum.high + x.high);
  }
  nook_units joined = nook_bias(nook_join_bias);
  nook_add(joined, sum.low / float(nook_tap_groups), nook_join_layer);
  nook_add(joined, sum.high / float(nook_tap_groups), nook_join_layer + 8);
  nook_add(joined, dot(normal, viewer), nook_join_layer + 16);
  joined = nook_prelu(joined, nook_join_bias);
  vec4 last = nook_network[nook_out_layer + 2];  // bias, negative slope, positive slope
  float y = dot(joined.low, nook_network[nook_out_layer]) + dot(joined.high, nook_network[nook_out_layer + 1]) + last.x;
  return max(y, 0.0) * last.z + min(y, 0.0) * last.y;
}
