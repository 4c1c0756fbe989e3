#version 330 core
// GTAO with a visibility bitmask (O. Therrien, Y. Levesque, G. Gilet, Screen space indirect lighting with
// visibility bitmask, 2023). Each tap is treated as an occluder of constant thickness: it closes the sectors
// between its front and its back. Light can therefore pass behind thin objects. Each slice is divided into 32
// sectors. The sectors have equal angles, as published, or equal cosine-weighted shares.
#include "bakers/lab/nnao/shaders/baseline.glsl"
#include "bakers/measure/nnao/shaders/slice.glsl"

uniform float thickness;     // in radii
uniform bool equal_weights;  // true: the sectors have equal cosine-weighted shares

// Returns the position of an angle in the slice's visible half, from 0 to 1.
float sector_place(float angle, float tilt) {
  float low = tilt - 0.5 * pi;
  float inside = clamp(angle, low, tilt + 0.5 * pi);
  if (!equal_weights) return (inside - low) / pi;
  return (arc(low, tilt) + sign(inside) * arc(inside, tilt)) / open_arc(tilt);
}

uint sectors_between(float from, float to) {
  int first = int(round(32.0 * from)), count = int(round(32.0 * to)) - first;
  if (count <= 0) return 0u;
  return (count >= 32 ? 0xffffffffu : (1u << count) - 1u) << first;
}

int set_bits(uint bits) {
  bits -= bits >> 1 & 0x55555555u;
  bits = (bits & 0x33333333u) + (bits >> 2 & 0x33333333u);
  bits = bits + (bits >> 4) & 0x0f0f0f0fu;
  return int(bits * 0x01010101u >> 24);
}

uint closed_sectors(Slice slice, float side, vec3 position, vec3 viewer, vec2 radius, vec2 noise) {
  uint closed = 0u;
  for (int k = 0; k < steps; ++k) {
    ivec2 at = stepped(side * slice.direction, step_px(k, noise, radius.y));
    float depth = tap_depth(at);
    if (depth == no_surface) continue;
    vec3 tap = position_at(at, depth), front = tap - position;
    float away = length(front);
    if (!(away < radius.x)) continue;
    vec3 back = front + normalize(tap) * thickness * radius.x;
    float front_place =
        sector_place(side * acos(clamp(dot(front, viewer) / away, -1.0, 1.0)), slice.tilt);
    float back_place =
        sector_place(side * acos(clamp(dot(back, viewer) / length(back), -1.0, 1.0)), slice.tilt);
    closed |= sectors_between(min(front_place, back_place), max(front_place, back_place));
  }
  return closed;
}

float baseline_ao(ivec2 pixel, vec3 position, vec3 normal, vec2 radius, vec2 noise) {
  vec3 viewer = normalize(-position);
  float open = 0.0, all = 0.0;
  for (int i = 0; i < groups; ++i) {
    Slice slice = make_slice(i, noise, normal, viewer);
    uint closed = closed_sectors(slice, 1.0, position, viewer, radius, noise) |
                  closed_sectors(slice, -1.0, position, viewer, radius, noise);
    float weight = equal_weights ? slice.projected * open_arc(slice.tilt) : 1.0;
    open += weight * (1.0 - float(set_bits(closed)) / 32.0);
    all += weight;
  }
  return all > 0.0 ? open / all : 1.0;
}
