// Finds which neighbours of a pixel lie on the pixel's surface, in the same way as XeGTAO's denoiser (F.
// Strugar, S. Mccalla, Intel XeGTAO, 2021). The left, right, lower and upper neighbour have two bits each.
// The value 0 means that an edge lies between.

// The depth of pixels without a surface. It is far away, but small enough that edges and weights stay finite.
const float far_depth = 1.0e6;  // metres

// There is an edge to a neighbour if the neighbour's depth differs by 1.1 % of the pixel's depth or more. The
// same must hold after the slope between the opposite neighbours is subtracted.
vec4 edge_weights(float centre, vec4 neighbours) {
  vec4 steps_m = neighbours - centre;
  vec2 slope = 0.5 * (steps_m.yw - steps_m.xz);
  vec4 bends = steps_m + vec4(slope.x, -slope.x, slope.y, -slope.y);
  return clamp(1.25 - min(abs(steps_m), abs(bends)) / (0.011 * centre), 0.0, 1.0);
}

float pack_edges(vec4 weights) {
  return dot(floor(2.9 * weights + 0.5), vec4(64.0, 16.0, 4.0, 1.0)) / 255.0;
}

vec4 unpack_edges(float packed_edges) {
  uint bits = uint(packed_edges * 255.0 + 0.5);
  return vec4((uvec4(bits) >> uvec4(6u, 4u, 2u, 0u)) & 3u) / 3.0;
}
