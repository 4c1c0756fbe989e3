#version 330 core
// A version of the AO pass of VTK 9, written from its description (Kitware, Screen-space ambient occlusion in
// VTK 9.0, 2020, and vtkSSAOPass.h). A point in the hemisphere is occluded if the depth buffer is in front of
// it by more than a bias. Two things are from J. Chapman's tutorial of SSAO (2013): the points, and the
// smaller weight of surfaces whose depth differs from the pixel's.
#include "bakers/lab/nnao/shaders/baseline.glsl"
#include "bakers/lab/nnao/shaders/hemisphere.glsl"

uniform float bias;  // in radii

float baseline_ao(ivec2 pixel, vec3 position, vec3 normal, vec2 radius, vec2 noise) {
  float closed = 0.0;
  for (int i = 0; i < steps; ++i) {
    vec3 point = position + radius.x * hemisphere_point(i, steps, noise, normal);
    if (point.z > -1.0e-3) continue;
    ivec2 at = pixel_of(point);
    float depth = tap_depth(at);
    if (-point.z - depth < bias * radius.x) continue;
    closed += smoothstep(0.0, 1.0, radius.x / max(abs(-position.z - depth), 1.0e-6));
  }
  return 1.0 - closed / float(steps);
}
