// Finds which neighbours of a pixel lie on the same surface as the pixel, in the same way as XeGTAO's denoiser
// (F. Strugar, S. Mccalla, Intel XeGTAO, 2021). The packed value has two bits for each of the left, right,
// lower and upper neighbour. The value 0 means that there is an edge between the pixel and this neighbour.

// The depth of pixels without a surface. It is far away, but small enough that edges and weights stay finite.
const float far_depth = 1.0e6;  // metres

// There is an edge to a neighbour if the neighbour's depth differs from the pixel's depth by at least 1.1 % of
// the pixel's depth. The difference must still be that large after the slope, which is computed from opposite
// neighbours, is subtracted.
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
