#version 330 core
// Makes one of XeGTAO's depth levels from the next finer level, or the finest level from the host's depth.
#include "bakers/lab/nnao/shaders/edges.glsl"
#include "bakers/lab/nnao/shaders/depth_levels.glsl"

uniform sampler2D finer_image;
uniform bool from_host;

out float result;

float finer(int x, int y) {
  return texelFetch(finer_image, 2 * ivec2(gl_FragCoord.xy) + ivec2(x, y), 0).r;
}

void main() {
  if (from_host) {
    result = min(texelFetch(finer_image, ivec2(gl_FragCoord.xy), 0).r, far_depth);
    return;
  }
  result = coarser_depth(vec4(finer(0, 0), finer(1, 0), finer(0, 1), finer(1, 1)));
}
