// Computes how steeply depth changes from a texel to its neighbours, and which neighbours are on the same
// surface. The filter reads the second result from 8 bits that are stored beside AO.
#include "shaders/nnao/depth.glsl"

// The components are the neighbours on the left, on the right, below and above.
struct NookNeighbours {
  // The change of depth from one texel to the next, along +x or +y, divided by the extent at the neighbour. On
  // a plane, the slopes on both sides of an axis are equal, because 1 / depth (orthographic: depth) is linear
  // on the screen.
  vec4 slope;
  // 1: the neighbour is on the same surface; 0: there is an edge, or no neighbour. A texel with almost no
  // connected neighbours gets a weak connection to each neighbour that has a surface. Otherwise nothing would
  // remove its noise, and thin gaps would become rows of dots. XeGTAO's denoiser does the same.
  vec4 connected;
};

NookNeighbours nook_neighbours_of(ivec2 texel, float depth) {
  vec4 depths = vec4(nook_depth_near(texel - ivec2(1, 0)), nook_depth_near(texel + ivec2(1, 0)),
                     nook_depth_near(texel - ivec2(0, 1)), nook_depth_near(texel + ivec2(0, 1)));
  NookNeighbours found;
  found.slope = (depths - depth) / (nook_spread.x * depths + nook_spread.y) * vec4(-1.0, 1.0, -1.0, 1.0);
  // The surface is assumed to continue beyond the border of the screen.
  vec4 inside = vec4(vec2(texel), nook_surface_last - vec2(texel)).xzyw;
  found.slope = mix(found.slope.yxwz, found.slope, greaterThan(inside, vec4(0.0)));
  // There is an edge if the texel's depth differs from the neighbour's depth, and also from the depth of the
  // straight line through the neighbours on both sides.
  vec4 bend = 0.5 * abs(found.slope.xxzz - found.slope.yyww);
  vec4 off = min(abs(found.slope), bend) * nook_edge_scale(depth);
  found.connected = min(clamp(1.25 - off, 0.0, 1.0), inside);
  float least = 0.5 - 0.2 * dot(found.connected, vec4(1.0));
  found.connected = max(found.connected, mix(vec4(0.0), min(vec4(least), inside), notEqual(depths, vec4(nook_no_surface))));
  return found;
}

// Packs `connected` into 8 bits, two for each neighbour. Returns a multiple of 1 / 255.
float nook_packed_edges(vec4 connected) {
  return dot(floor(3.0 * connected + 0.5), vec4(64.0, 16.0, 4.0, 1.0)) / 255.0;
}
