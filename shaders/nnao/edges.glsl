// Computes how steeply depth changes from a texel to its neighbours, and which of them lie on the same
// surface. The filter reads the second as 8 bits beside AO.
#include "shaders/nnao/depth.glsl"

// Left, right, below, above.
struct NookNeighbours {
  // The change of depth for a step to the left, right and so on. It is divided by the extent at the neighbour
  // and counted along +x or +y. On a plane, both sides of an axis are equal, because 1 / depth (orthographic:
  // depth) is linear.
  vec4 slope;
  vec4 connected;  // 1: the same surface; 0: an edge, or no neighbour
};

NookNeighbours nook_neighbours_of(ivec2 texel, float depth) {
  vec4 depths = vec4(nook_depth_near(texel - ivec2(1, 0)), nook_depth_near(texel + ivec2(1, 0)),
                     nook_depth_near(texel - ivec2(0, 1)), nook_depth_near(texel + ivec2(0, 1)));
  NookNeighbours found;
  found.slope = (depths - depth) / (nook_spread.x * depths + nook_spread.y) * vec4(-1.0, 1.0, -1.0, 1.0);
  // Beyond the border of the screen the surface is assumed to continue.
  vec4 inside = vec4(vec2(texel), nook_surface_last - vec2(texel)).xzyw;
  found.slope = mix(found.slope.yxwz, found.slope, greaterThan(inside, vec4(0.0)));
  // An edge is where depth differs both from the neighbour's and from the line through the neighbours on both
  // sides.
  vec4 bend = 0.5 * abs(found.slope.xxzz - found.slope.yyww);
  vec4 off = min(abs(found.slope), bend) * nook_edge_scale(depth);
  found.connected = min(clamp(1.25 - off, 0.0, 1.0), inside);
  return found;
}

// Packs them in 255ths, two bits for each neighbour.
float nook_packed_edges(vec4 connected) {
  return dot(floor(3.0 * connected + 0.5), vec4(64.0, 16.0, 4.0, 1.0)) / 255.0;
}
