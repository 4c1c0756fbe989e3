#version 330 core
// SSAO+ (D. Filion, R. McNaughton, StarCraft II effects and techniques, SIGGRAPH 2008 courses) tests points
// in the hemisphere around the normal. The occlusion of a point decreases with the distance by which the
// surface is in front of it.
#include "bakers/lab/nnao/shaders/baseline.glsl"
#include "bakers/lab/nnao/shaders/ball.glsl"

uniform float bias;  // in radii

float baseline_ao(ivec2 pixel, vec3 position, vec3 normal, vec2 radius, vec2 noise) {
  vec3 viewer = normalize(-position);
  float facing = dot(normal, viewer);
  // A texel stores only the depth at its centre. On a slanted plane, the stored depth may be nearer than the
  // point by this much.
  float texel = 1.0 / (pixels_per_metre(-position.z) * radius.x);
  float margin = bias + 0.75 * texel * sqrt(max(1.0 - facing * facing, 0.0)) / max(facing, 0.02);
  float closed = 0.0;
  for (int i = 0; i < steps; ++i) {
    vec3 offset = ball_point(i, steps, noise);
    vec3 point = position + radius.x * (dot(offset, normal) < 0.0 ? -offset : offset);
    if (point.z > -1.0e-3) continue;
    ivec2 at = pixel_of(point);
    float in_front = (-point.z - tap_depth(at)) / radius.x;
    if (in_front > margin) closed += in_front > 1.0 ? 1.0 / (in_front * in_front) : 1.0;
  }
  return 1.0 - closed / float(steps);
}
