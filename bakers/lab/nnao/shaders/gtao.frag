#version 330 core
// GTAO (J. Jimenez, X. Wu, A. Pesce, A. Jarabo, Practical realtime strategies for accurate indirect
// occlusion, 2016) integrates two horizons per slice in closed form. The effect of an occluder fades out
// towards the radius. The sum over the slices is divided by the sum that the same slices give for an open
// hemisphere. An open plane therefore has AO 1 even with few slices.
#include "bakers/lab/nnao/shaders/baseline.glsl"
#include "bakers/measure/nnao/shaders/slice.glsl"

uniform float falloff;  // distance at which the fading begins, in radii

// Returns the cosine of the horizon on one side (1 or -1).
float horizon(Slice slice, float side, vec3 position, vec3 viewer, vec2 radius, vec2 noise) {
  float lowest = -side * sin(slice.tilt), highest = lowest;
  // The weight of a tap is `fade.y` minus `fade.x` times its distance in metres.
  vec2 fade = vec2(1.0 / radius.x, 1.0) / (1.0 - falloff);
  for (int k = 0; k < steps; ++k) {
    ivec2 at = stepped(side * slice.direction, step_px(k, noise, radius.y));
    float depth = tap_depth(at);
    if (depth == no_surface) continue;
    vec3 v = position_at(at, depth) - position;
    float squared = dot(v, v), inverse = inversesqrt(squared);
    float weight = clamp(fade.y - squared * inverse * fade.x, 0.0, 1.0);
    highest = max(highest, mix(lowest, dot(v, viewer) * inverse, weight));
  }
  return highest;
}

float baseline_ao(ivec2 pixel, vec3 position, vec3 normal, vec2 radius, vec2 noise) {
  vec3 viewer = normalize(-position);
  float open = 0.0, all = 0.0;
  for (int i = 0; i < groups; ++i) {
    Slice slice = make_slice(i, noise, normal, viewer);
    float behind = -acos(clamp(horizon(slice, -1.0, position, viewer, radius, noise), -1.0, 1.0));
    float ahead = acos(clamp(horizon(slice, 1.0, position, viewer, radius, noise), -1.0, 1.0));
    behind = max(behind, slice.tilt - 0.5 * pi);
    ahead = min(ahead, slice.tilt + 0.5 * pi);
    open += slice.projected * (arc(behind, slice.tilt) + arc(ahead, slice.tilt));
    all += slice.projected * open_arc(slice.tilt);
  }
  return all > 0.0 ? open / all : 1.0;
}
