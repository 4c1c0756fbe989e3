#version 330 core
// The edge-aware denoiser, as a fragment shader that computes one pixel per thread.
#include "bakers/lab/nnao/shaders/denoise.glsl"

uniform sampler2D ao_image;
uniform sampler2D edge_image;
uniform ivec2 size_px;

out float result;

ivec2 beside(int x, int y) {
  return clamp(ivec2(gl_FragCoord.xy) + ivec2(x, y), ivec2(0), size_px - 1);
}

float ao_at(int x, int y) {
  return texelFetch(ao_image, beside(x, y), 0).r;
}

vec4 edges_at(int x, int y) {
  return unpack_edges(texelFetch(edge_image, beside(x, y), 0).r);
}

void main() {
  Edges edges = Edges(edges_at(0, 0), edges_at(-1, 0), edges_at(1, 0), edges_at(0, -1), edges_at(0, 1));
  result = denoised(edges, ao_at(0, 0), vec4(ao_at(-1, 0), ao_at(1, 0), ao_at(0, -1), ao_at(0, 1)),
                    vec4(ao_at(-1, -1), ao_at(1, -1), ao_at(-1, 1), ao_at(1, 1)));
}
