#version 330 core
// HBAO. L. Bavoil, M. Sainz, R. Dimitrov, Image-space horizon-based ambient occlusion, SIGGRAPH 2008 talks: per direction the
// sine of the horizon over that of the tangent plane, each rise weighted by 1 - (distance / radius)^2.
#include "bakers/measure/nnao/shaders/baseline.glsl"

uniform float bias;  // of the tangent angle, radians

// Sine of the tangent plane's rise below v, biased. Rises are measured from the plane across the direction to the viewer: from
// the screen's plane, surfaces at the border of a wide view would face away.
float tangent_sine(vec3 v, vec3 normal, vec3 viewer) {
  vec3 across = normalize(v - dot(v, viewer) * viewer);
  return sin(min(atan(-dot(normal, across), dot(normal, viewer)) + bias, 0.5 * pi));
}

float baseline_ao(ivec2 pixel, vec3 position, vec3 normal, vec2 radius, vec2 noise) {
  vec3 viewer = normalize(-position);
  float closed = 0.0;
  for (int i = 0; i < groups; ++i) {
    float angle = 2.0 * pi * (float(i) + noise.x) / float(groups);
    vec2 direction = vec2(cos(angle), sin(angle));
    float highest = -1.0;
    for (int k = 0; k < steps; ++k) {
      float distance_px = max(float(k) + 1.0, radius.y * (float(k) + noise.y) / float(steps));
      ivec2 at = stepped(direction, distance_px);
      float depth = depth_at(at);
      if (depth == no_surface) continue;
      vec3 v = position_at(at, depth) - position;
      float away = length(v), sine = dot(v, viewer) / away;
      // Along the texel's own direction: a plane must not rise over itself.
      float lowest = max(highest, tangent_sine(v, normal, viewer));
      if (!(away < radius.x) || sine <= lowest) continue;
      closed += (1.0 - away * away / (radius.x * radius.x)) * (sine - lowest);
      highest = sine;
    }
  }
  return 1.0 - closed / float(groups);
}
