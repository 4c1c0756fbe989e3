#version 330 core
// Runs the library's bilateral blur along one axis, on the AO of other methods. A test compares the result
// with the library's own blur.
#include "bakers/measure/nnao/shaders/surface.glsl"

uniform sampler2D ao_image;
uniform ivec2 axis;
uniform float sharpness;

out float result;

const float weights[4] = float[4](1.0, 0.875, 0.5, 0.125);

float same_surface(ivec2 at, float depth, vec3 position, vec3 normal, float radius) {
  vec3 offset = position_at(at, depth) - position;
  float turn = max(dot(normal_at(at), normal), 0.0);
  turn *= turn;
  turn *= turn;
  float off_plane = abs(dot(offset, normal)) * sharpness / radius;
  float near = 0.02 * max(1.0 - 4.0 * length(offset) / radius, 0.0);
  return max(max(1.0 - off_plane, 0.0) * turn * turn, near);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float centre = texelFetch(ao_image, pixel, 0).r;
  float depth = depth_at(pixel);
  result = centre;
  if (depth == no_surface) return;
  vec3 position = position_at(pixel, depth), normal = normal_at(pixel);
  float radius = pixel_radius(depth).x, sum = 0.0, total = 0.0;
  for (int i = 1; i <= 3; ++i)
    for (int side = -1; side <= 1; side += 2) {
      ivec2 at = pixel + side * i * axis;
      float at_depth = depth_at(at);
      if (at_depth == no_surface) continue;
      float weight = weights[i] * same_surface(at, at_depth, position, normal, radius);
      sum += weight * texelFetch(ao_image, at, 0).r;
      total += weight;
    }
  float own = clamp(2.0 * total - 0.12, 0.005, 1.0);
  result = (sum + own * centre) / (total + own);
}
