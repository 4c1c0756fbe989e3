#version 330 core
// Writes the edges for the edge-aware denoiser, for baselines that do not write them.
#include "bakers/measure/nnao/shaders/surface.glsl"
#include "bakers/lab/nnao/shaders/edges.glsl"

out float result;

float near_depth(ivec2 at) {
  return min(texelFetch(depth_image, clamp(at, ivec2(0), size_px - 1), 0).r, far_depth);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 neighbours = vec4(near_depth(pixel - ivec2(1, 0)), near_depth(pixel + ivec2(1, 0)), near_depth(pixel - ivec2(0, 1)),
                         near_depth(pixel + ivec2(0, 1)));
  result = pack_edges(edge_weights(near_depth(pixel), neighbours));
}
