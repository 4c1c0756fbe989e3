// The horizon form; network.h defines it. Eight units are two vec4.
uniform vec4 nook_network[NOOK_HORIZON_VEC4S];  // tap, direction, join, out, in the order of network.h
// Directions. Not a constant: compilers would unroll them all, into more code than caches hold.
uniform int nook_tap_groups;

// Where each layer begins, and its bias, after which negative and positive slopes follow.
const int nook_tap_layer = NOOK_HORIZON_TAP;
const int nook_tap_bias = nook_tap_layer + NOOK_HORIZON_TAP_INPUTS * NOOK_HORIZON_UNIT_VEC4S;
const int nook_direction_layer = NOOK_HORIZON_DIRECTION;
const int nook_direction_bias = nook_direction_layer + NOOK_HORIZON_DIRECTION_INPUTS * NOOK_HORIZON_UNIT_VEC4S;
const int nook_join_layer = NOOK_HORIZON_JOIN;
const int nook_join_bias = nook_join_layer + NOOK_HORIZON_JOIN_INPUTS * NOOK_HORIZON_UNIT_VEC4S;
const int nook_out_layer = NOOK_HORIZON_OUT;

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

// The sky is a surface far beyond any radius; the square of this depth is still a float.
const float nook_sky_depth = 1.0e15;

// Returns the elevation, the angle and the distance in radii of a tap on the screen.
vec3 nook_tap_input(ivec2 at, vec3 position, vec3 normal, vec3 viewer, float radius) {
  float depth = min(nook_surface_depth(at), nook_sky_depth);
  vec3 v = nook_position(nook_surface_rays, at, depth) - position;
  float away = max(length(v), 1.0e-12);
  return vec3(dot(v, normal) / away, dot(v, viewer) / away, away / radius);
}

// Returns the same off the screen, where the pixel's own plane continues.
vec3 nook_plane_tap_input(float across, float facing, float distance_r) {
  float slope = across / max(facing, 0.05), stretch = sqrt(1.0 + slope * slope);
  return vec3(0.0, -slope / stretch, distance_r * stretch);
}

nook_units nook_tap_units(vec3 tap_input) {
  float nearness = max(1.0 - 0.5 * tap_input.z, 0.0);
  nook_units x = nook_bias(nook_tap_bias);
  nook_add(x, vec4(tap_input.xy, nearness, tap_input.x * nearness), nook_tap_layer);
  nook_add(x, tap_input.y * nearness, nook_tap_layer + 8);
  return nook_prelu(x, nook_tap_bias);
}

// Adds the number of steps off the screen to taps_off_screen.
nook_units nook_direction_units(ivec2 texel, vec2 direction, vec2 noise, vec3 position, vec3 normal, vec3 viewer,
                                vec2 scale, vec2 radius, inout float taps_off_screen) {
  nook_units most = nook_units(vec4(-nook_no_surface), vec4(-nook_no_surface));
  nook_units sum = nook_units(vec4(0.0), vec4(0.0));
  vec3 along = vec3(direction, 0.0);
  vec3 across_viewer = normalize(along - dot(along, viewer) * viewer);
  float across = dot(normal, across_viewer), facing = dot(normal, viewer);
  for (int i = 0; i < NOOK_STEPS; ++i) {
    float distance_px = nook_step_distance(i, NOOK_STEPS, noise, radius.y);
    ivec2 at = nook_tapped_texel(texel, nook_horizon_tap(direction, distance_px, scale));
    vec3 tap_input;
    if (nook_inside(at, nook_surface_size)) {
      tap_input = nook_tap_input(at, position, normal, viewer, radius.x);
    } else {
      tap_input = nook_plane_tap_input(across, facing, distance_px / radius.y);
      taps_off_screen += 1.0;
    }
    nook_units hidden = nook_tap_units(tap_input);
    most = nook_units(max(most.low, hidden.low), max(most.high, hidden.high));
    sum = nook_units(sum.low + hidden.low, sum.high + hidden.high);
  }
  nook_units x = nook_bias(nook_direction_bias);
  nook_add(x, most.low, nook_direction_layer);
  nook_add(x, most.high, nook_direction_layer + 8);
  nook_add(x, sum.low / float(NOOK_STEPS), nook_direction_layer + 16);
  nook_add(x, sum.high / float(NOOK_STEPS), nook_direction_layer + 24);
  nook_add(x, across, nook_direction_layer + 32);
  nook_add(x, facing, nook_direction_layer + 34);
  return nook_prelu(x, nook_direction_bias);
}

float nook_evaluate(ivec2 texel, vec3 position, vec3 normal, vec2 scale, vec2 radius) {
  vec2 noise = nook_tap_noise(texel);
  vec3 viewer = nook_to_viewer(position);
  nook_units sum = nook_units(vec4(0.0), vec4(0.0));
  float taps_off_screen = 0.0;
  for (int i = 0; i < nook_tap_groups; ++i) {
    float angle = nook_direction_angle(i, nook_tap_groups, noise);
    nook_units x = nook_direction_units(texel, vec2(cos(angle), sin(angle)), noise, position, normal, viewer, scale,
                                        radius, taps_off_screen);
    sum = nook_units(sum.low + x.low, sum.high + x.high);
  }
  float directions = float(nook_tap_groups), taps = directions * float(NOOK_STEPS);
  // A screen of one or two pixels contains no information on occluders.
  if (taps_off_screen == taps) return 1.0;
  nook_units joined = nook_bias(nook_join_bias);
  nook_add(joined, sum.low / directions, nook_join_layer);
  nook_add(joined, sum.high / directions, nook_join_layer + 8);
  nook_add(joined, dot(normal, viewer), nook_join_layer + 16);
  nook_add(joined, taps_off_screen / taps, nook_join_layer + 18);
  joined = nook_prelu(joined, nook_join_bias);
  vec4 last = nook_network[nook_out_layer + 2];  // bias, negative slope, positive slope
  float y = dot(joined.low, nook_network[nook_out_layer]) + dot(joined.high, nook_network[nook_out_layer + 1]) + last.x;
  return max(y, 0.0) * last.z + min(y, 0.0) * last.y;
}
