#version 330 core
// A version of Filament's SAO (Google, Filament), after M. McGuire, M. Mara, D. Luebke, Scalable ambient
// obscurance, 2012. Taps lie on a spiral. The occlusion of a tap is its elevation divided by its distance.
// Filament adds three things, with lengths in radii here: a peak term that keeps close taps from dominating,
// a square root, and tap distances that grow quadratically.
#include "bakers/lab/nnao/shaders/baseline.glsl"

uniform float bias;  // in radii

#ifndef NOOK_TURNS
#define NOOK_TURNS 3  // turns of the spiral
#endif

float baseline_ao(ivec2 pixel, vec3 position, vec3 normal, vec2 radius, vec2 noise) {
  const float peak = 0.1;
  float sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    float share = (float(i) + noise.x) / float(steps), angle = 2.0 * pi * (share * float(NOOK_TURNS) + noise.y);
    ivec2 at = stepped(vec2(cos(angle), sin(angle)), max(1.0, share * share * radius.y));
    float depth = tap_depth(at);
    if (depth == no_surface) continue;
    vec3 v = (position_at(at, depth) - position) / radius.x;
    float squared = dot(v, v), near = max(1.0 - squared, 0.0);
    sum += near * near * max(dot(v, normal) - bias, 0.0) / (squared + peak * peak);
  }
  return 1.0 - sqrt(2.0 * pi * peak * sum / float(steps));
}
