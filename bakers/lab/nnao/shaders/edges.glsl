// Finds which neighbours of a pixel lie on its surface, like XeGTAO's denoiser (F. Strugar, S. Mccalla, Intel
// XeGTAO, 2021): left, right, below and above in two bits each, 0 across an edge.

// Depth without a surface: far away, but with finite edges and weights.
const float far_depth = 1.0e6;  // metres

// A neighbour is across an edge if its depth differs by 1.1 % of the pixel's depth. Both its own depth and
// the depth along the slope between the opposite neighbours must differ.
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
