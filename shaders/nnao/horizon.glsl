// Evaluates the horizon form of the network; network.h defines it. Four units are stored in one vec4. The
// layers are tap, direction, join and out, in the order of network.h. Where the network has a mean, the
// shader computes a sum, because the weights already include the division.
uniform vec4 nook_network[NOOK_HORIZON_VEC4S];
// The number of directions. If there are many, the number is a uniform. With a constant, compilers would
// unroll the loop into more code than fits into the instruction cache.
#if NOOK_DIRECTIONS > 4
uniform int nook_tap_groups;
#define NOOK_LOOPED_DIRECTIONS nook_tap_groups
#else
#define NOOK_LOOPED_DIRECTIONS NOOK_DIRECTIONS
#endif

// The cosine and sine of the angle between two directions.
const vec2 nook_turn = vec2(cos(6.2831853 / float(NOOK_DIRECTIONS)), sin(6.2831853 / float(NOOK_DIRECTIONS)));

struct NookCentre {
  vec2 place;  // the texel's centre
  vec3 position, normal, viewer;
  float half_nearness;          // 1 / 2r
  float min_squared;            // minimum squared distance of a tap, square metres
  float steps_px[NOOK_STEPS];   // distance of each tap of a direction, in texels along the screen's y axis
};

vec4 nook_products(vec4 x, int weights) {
  return x.x * nook_network[weights] + x.y * nook_network[weights + 1] + x.z * nook_network[weights + 2] +
         x.w * nook_network[weights + 3];
}

vec4 nook_leaky(vec4 x, int slope) {
  return max(x, nook_network[slope] * x);
}

struct NookHorizon {
  vec4 most, sum;  // maximum and sum of the units over the steps
  float bound;     // maximum over the steps of elevation times nearness, at least 0
};

void nook_add_tap(inout NookHorizon found, NookCentre centre, vec2 place) {
  vec2 texel = clamp(floor(place), vec2(0.0), nook_surface_last);
  vec3 v = nook_position(nook_surface_rays, texel, nook_depth_at(ivec2(texel))) - centre.position;
  float squared = max(dot(v, v), centre.min_squared), per_metre = inversesqrt(squared);
  float elevation = dot(v, centre.normal) * per_metre, angle = dot(v, centre.viewer) * per_metre;
  float nearness = clamp(1.0 - squared * per_metre * centre.half_nearness, 0.0, 1.0);
  vec4 x = nook_network[NOOK_HORIZON_TAP] + angle * nook_network[NOOK_HORIZON_TAP + 1] +
           nearness * (nook_network[NOOK_HORIZON_TAP + 2] + angle * nook_network[NOOK_HORIZON_TAP + 3]);
  vec4 hidden = max(elevation * x - nook_network[NOOK_HORIZON_TAP_THRESHOLD], 0.0);
  found.most = max(found.most, hidden);
  found.sum += hidden;
  found.bound = max(found.bound, elevation * nearness);
}

struct NookSums {
  vec4 units;
  float bound;
  vec3 bent;
};

// Adds the taps of one direction to the sums. `direction` is a unit vector in view space. `gate` and
// `bent_gate` are the contributions to the gates that are the same for all directions.
void nook_add_direction(inout NookSums sums, NookCentre centre, vec2 direction, vec2 scale, vec4 gate, vec2 bent_gate) {
  vec2 along_px = nook_horizon_tap(direction, 1.0, scale);
  NookHorizon found = NookHorizon(vec4(0.0), vec4(0.0), 0.0);
  for (int i = 0; i < NOOK_STEPS; ++i) nook_add_tap(found, centre, centre.place + along_px * centre.steps_px[i]);
  // `across` is the dot product of the normal and a unit vector. This vector is perpendicular to the direction
  // to the viewer and lies in the plane of `direction`.
  float towards = dot(direction, centre.viewer.xy), per_length = inversesqrt(1.0 - towards * towards);
  float across = (dot(direction, centre.normal.xy) - towards * dot(centre.normal, centre.viewer)) * per_length;
  vec4 x = nook_products(found.most, NOOK_HORIZON_DIRECTION) + nook_products(found.sum, NOOK_HORIZON_DIRECTION + 4);
  sums.units += nook_leaky(x * (gate + across * nook_network[NOOK_HORIZON_DIRECTION_GATE]), NOOK_HORIZON_DIRECTION_SLOPE);
  sums.bound += found.bound;
#if NOOK_BENT_NORMALS
  vec2 bent = vec2(dot(found.most, nook_network[NOOK_HORIZON_BENT]) + dot(found.sum, nook_network[NOOK_HORIZON_BENT + 2]),
                   dot(found.most, nook_network[NOOK_HORIZON_BENT + 1]) + dot(found.sum, nook_network[NOOK_HORIZON_BENT + 3]));
  bent *= bent_gate + across * nook_network[NOOK_HORIZON_BENT_GATE].xy;
  bent.x *= per_length;
  sums.bent += vec3(bent.x * direction, 0.0) + (bent.y - bent.x * towards) * centre.viewer;
#endif
}

// Returns the distance of a place from the nearest border of the screen, in texels.
float nook_border_distance(vec2 place) {
  vec2 inside = min(place, nook_surface_last + 1.0 - place);
  return min(inside.x, inside.y);
}

// Returns AO. In passes with bent normals, `bent` is set to the bent normal, which is not normalised.
float nook_evaluate(ivec2 texel, vec3 position, vec3 normal, vec2 scale, vec2 radius, out vec3 bent) {
  vec2 noise = nook_tap_noise(texel);
  NookCentre centre;
  centre.place = vec2(texel) + 0.5;
  centre.position = position;
  centre.normal = normal;
  centre.viewer = nook_to_viewer(position);
  centre.half_nearness = 0.5 / radius.x;
  // At the border of the screen, a tap can be clamped to the pixel itself. The v of such a tap should be 0,
  // but is a rounding error that acts like a random direction. So all distances are raised to at least half a
  // pixel. For fields of view up to 120 degrees, all other pixels are farther away than this.
  float half_pixel = 0.5 / max(abs(scale.x), abs(scale.y));
  centre.min_squared = half_pixel * half_pixel;
  for (int i = 0; i < NOOK_STEPS; ++i) centre.steps_px[i] = nook_step_distance(i, NOOK_STEPS, noise, radius.y);
  float facing = dot(normal, centre.viewer);
  vec4 gate = 1.0 + facing * nook_network[NOOK_HORIZON_DIRECTION_GATE + 1];
  float angle = nook_direction_angle(0, NOOK_DIRECTIONS, noise);
  vec2 direction = vec2(cos(angle), sin(angle));
  vec2 bent_gate = 1.0 + facing * nook_network[NOOK_HORIZON_BENT_GATE].zw;
  NookSums sums = NookSums(vec4(0.0), 0.0, normal);
  for (int i = 0; i < NOOK_LOOPED_DIRECTIONS; ++i) {
    nook_add_direction(sums, centre, direction, scale, gate, bent_gate);
    direction = vec2(direction.x * nook_turn.x - direction.y * nook_turn.y,
                     direction.x * nook_turn.y + direction.y * nook_turn.x);
  }
  float border = min(nook_border_distance(centre.place) / radius.y, 1.0);
  vec4 join_gate = 1.0 + facing * nook_network[NOOK_HORIZON_JOIN_GATE] + border * nook_network[NOOK_HORIZON_JOIN_GATE + 1];
  vec4 joined = nook_leaky(nook_products(sums.units, NOOK_HORIZON_JOIN) * join_gate, NOOK_HORIZON_JOIN_SLOPE);
  bent = sums.bent;
  return 1.0 + max(dot(joined, nook_network[NOOK_HORIZON_OUT]), -NOOK_HORIZON_BOUND / float(NOOK_DIRECTIONS) * sums.bound);
}
