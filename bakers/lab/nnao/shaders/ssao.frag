#version 330 core
// SSAO (M. Mittring, Finding next gen: CryEngine 2, SIGGRAPH 2007 courses) tests points in a ball around the
// pixel against the depth buffer, without normals. On a plane, half of the ball lies behind the surface. A
// pixel with half of its points occluded therefore counts as open.
#include "bakers/lab/nnao/shaders/baseline.glsl"
#include "bakers/lab/nnao/shaders/ball.glsl"

float baseline_ao(ivec2 pixel, vec3 position, vec3 normal, vec2 radius, vec2 noise) {
  float closed = 0.0;
  for (int i = 0; i < steps; ++i) {
    vec3 point = position + radius.x * ball_point(i, steps, noise);
    if (point.z > -1.0e-3) continue;
    ivec2 at = pixel_of(point);
    float depth = tap_depth(at);
    // Surfaces far in front of the pixel do not count.
    float in_front = -position.z - depth;
    if (depth < -point.z) closed += in_front > radius.x ? radius.x / in_front : 1.0;
  }
  return 2.0 - 2.0 * closed / float(steps);
}
