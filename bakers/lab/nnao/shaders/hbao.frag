#version 330 core
// HBAO (L. Bavoil, M. Sainz, R. Dimitrov, Image-space horizon-based ambient occlusion, SIGGRAPH 2008 talks).
// For each direction, the occlusion is the sine of the horizon minus the sine of the tangent plane. Each
// increase of the sine is weighted by 1 - (distance / radius)^2.
#include "bakers/lab/nnao/shaders/baseline.glsl"

uniform vec2 bias_turn;  // cosine and sine of the bias of the tangent angle

// Returns the sine of the biased elevation of the tangent plane in the direction of `v`. Elevations are
// measured from the plane perpendicular to the direction to the viewer. If they were measured from the screen
// plane, surfaces at the border of a wide view would face away. `along` is the component of `v` towards the
// viewer. `facing` is the component of the normal towards the viewer.
float tangent_sine(vec3 v, float along, vec3 normal, vec3 viewer, float facing) {
  vec3 across = v - along * viewer;
  vec2 slope = vec2(facing * length(across), -dot(normal, across));  // the slope of the tangent plane as (run, rise)
  slope *= inversesqrt(max(dot(slope, slope), 1.0e-30));
  float rise = slope.y * bias_turn.x + slope.x * bias_turn.y;
  float run = slope.x * bias_turn.x - slope.y * bias_turn.y;
  // The biased angle is limited to a right angle.
  return run < 0.0 && slope.y > 0.0 ? 1.0 : rise;
}

float baseline_ao(ivec2 pixel, vec3 position, vec3 normal, vec2 radius, vec2 noise) {
  vec3 viewer = normalize(-position);
  float facing = dot(normal, viewer), squared_radius = radius.x * radius.x, fade = 1.0 / squared_radius;
  float closed = 0.0;
  for (int i = 0; i < groups; ++i) {
    float angle = 2.0 * pi * (float(i) + noise.x) / float(groups);
    vec2 direction = vec2(cos(angle), sin(angle));
    float highest = -1.0;
    for (int k = 0; k < steps; ++k) {
      float distance_px = max(float(k) + 1.0, radius.y * (float(k) + noise.y) / float(steps));
      ivec2 at = stepped(direction, distance_px);
      float depth = tap_depth(at);
      if (depth == no_surface) continue;
      vec3 v = position_at(at, depth) - position;
      float squared = dot(v, v), along = dot(v, viewer), sine = along * inversesqrt(squared);
      // Uses the exact direction to the texel, so that a plane does not occlude itself.
      float lowest = max(highest, tangent_sine(v, along, normal, viewer, facing));
      if (!(squared < squared_radius) || sine <= lowest) continue;
      closed += (1.0 - squared * fade) * (sine - lowest);
      highest = sine;
    }
  }
  return 1.0 - closed / float(groups);
}
