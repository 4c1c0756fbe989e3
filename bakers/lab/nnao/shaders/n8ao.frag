#version 330 core
// A version of N8AO (N8python, N8AO 2.0, 2026, three.js), written from its README. It samples points in a
// hemisphere. The effect of an occluder fades out over a separate distance. The neural denoiser, which is off
// by default, is not included. The README does not state the fade function and the margin, so we chose both.
#include "bakers/lab/nnao/shaders/baseline.glsl"
#include "bakers/lab/nnao/shaders/hemisphere.glsl"

uniform float falloff;  // in radii

float baseline_ao(ivec2 pixel, vec3 position, vec3 normal, vec2 radius, vec2 noise) {
  // A texel stores only the depth at its centre. On a slanted plane, the stored depth may be nearer than the
  // point by this much.
  float facing = dot(normal, normalize(-position));
  float slope = sqrt(max(1.0 - facing * facing, 0.0)) / max(facing, 0.02);
  float margin = (0.25 + 0.75 * slope) / pixels_per_metre(-position.z);
  float closed = 0.0;
  for (int i = 0; i < steps; ++i) {
    vec3 point = position + radius.x * hemisphere_point(i, steps, noise, normal);
    if (point.z > -1.0e-3) continue;
    ivec2 at = pixel_of(point);
    float depth = tap_depth(at);
    if (-point.z - depth < margin) continue;
    closed += smoothstep(0.0, 1.0, falloff * radius.x / max(abs(-position.z - depth), 1.0e-6));
  }
  return 1.0 - closed / float(steps);
}
