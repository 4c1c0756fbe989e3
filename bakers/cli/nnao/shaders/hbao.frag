#version 330 core
// HBAO. L. Bavoil, M. Sainz, R. Dimitrov, Image-space horizon-based ambient occlusion, SIGGRAPH 2008 talks: per direction the
// sine of the horizon over that of the tangent plane, each rise weighted by 1 - (distance / radius)^2.
#include "peer.glsl"

uniform float bias;  // of the tangent angle, radians

float peer_ao(ivec2 pixel, vec3 position, vec3 normal, vec2 radius, vec2 noise) {
  float closed = 0.0;
  for (int i = 0; i < groups; ++i) {
    float angle = 2.0 * pi * (float(i) + noise.x) / float(groups);
    vec2 direction = vec2(cos(angle), sin(angle));
    // The tangent plane rises by this much along the direction.
    float tangent = atan(-dot(normal.xy, direction), max(normal.z, 1.0e-3)) + bias;
    float highest = sin(min(tangent, 0.5 * pi));
    for (int k = 0; k < steps; ++k) {
      float distance_px = max(float(k) + 1.0, radius.y * (float(k) + noise.y) / float(steps));
      ivec2 at = stepped(direction, distance_px);
      float depth = depth_at(at);
      if (depth == no_surface) continue;
      vec3 v = position_at(at, depth) - position;
      float away = length(v), sine = v.z / away;
      if (!(away < radius.x) || sine <= highest) continue;
      closed += (1.0 - away * away / (radius.x * radius.x)) * (sine - highest);
      highest = sine;
    }
  }
  return 1.0 - closed / float(groups);
}
