#version 330 core
// Runs a version of Filament's blur along one axis. We wrote it from its description (Filament pull requests
// 3060 and 3074, 2020). It has eleven taps, at every second pixel. The weights are Gaussian with a standard
// deviation of 8 pixels. Taps at other depths get less weight.
#include "bakers/measure/nnao/shaders/surface.glsl"

uniform sampler2D ao_image;
uniform ivec2 axis;

out float result;

const float edge_m = 0.05;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float centre = texelFetch(ao_image, pixel, 0).r, depth = depth_at(pixel);
  result = centre;
  if (depth == no_surface) return;
  float sum = centre, total = 1.0;
  for (int i = 1; i <= 5; ++i)
    for (int side = -1; side <= 1; side += 2) {
      ivec2 at = pixel + 2 * side * i * axis;
      float off = (depth_at(at) - depth) / edge_m;
      float weight = exp(-float(i * i) / 32.0) * max(1.0 - off * off, 0.0);
      if (weight == 0.0) continue;
      sum += weight * texelFetch(ao_image, at, 0).r;
      total += weight;
    }
  result = sum / total;
}
