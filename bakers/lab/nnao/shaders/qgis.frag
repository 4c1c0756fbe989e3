#version 330 core
// A version of the AO pass of QGIS' 3D view, written from its description (QGIS pull requests 49144 and
// 49702, 2022). It tests points near the pixel, and darkens the pixel if the share of occluded points exceeds
// a threshold. The description refers to J. Chapman's tutorial of SSAO (2013), but does not say which shape
// the points fill. The default threshold is a half. Half of a ball lies behind a plane, so we assume that the
// points fill a ball and that normals are not used.
#include "bakers/lab/nnao/shaders/baseline.glsl"
#include "bakers/lab/nnao/shaders/ball.glsl"

uniform float threshold;  // share of the points
uniform float strength;

float baseline_ao(ivec2 pixel, vec3 position, vec3 normal, vec2 radius, vec2 noise) {
  float closed = 0.0;
  for (int i = 0; i < steps; ++i) {
    vec3 point = position + radius.x * ball_point(i, steps, noise);
    if (point.z > -1.0e-3) continue;
    ivec2 at = pixel_of(point);
    float depth = tap_depth(at);
    if (depth < -point.z) closed += smoothstep(0.0, 1.0, radius.x / max(abs(-position.z - depth), 1.0e-6));
  }
  return 1.0 - strength * max(closed / float(steps) - threshold, 0.0) / (1.0 - threshold);
}
