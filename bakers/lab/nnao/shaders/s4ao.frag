#version 330 core
// A form of S4AO of Godot's Compatibility renderer (J. Dummer, Godot pull request 109447, 2025), from its
// description and its comments. It uses a grid of 4 x 4 taps without its corners, turned for each pixel, on
// inverse depth and without normals. Taps lie opposite each other, so that they cancel on a plane, where
// inverse depth is linear. The weight of a tap is ours: its rise over the falloff, up to 1, and less beyond.
#include "bakers/lab/nnao/shaders/baseline.glsl"

uniform float falloff;  // share of the pixel's inverse depth
uniform float strength;

float baseline_ao(ivec2 pixel, vec3 position, vec3 normal, vec2 radius, vec2 noise) {
  float turn = 0.5 * pi * noise.x, closed = 0.0;
  vec2 along = vec2(cos(turn), sin(turn)) * radius.y / 1.5;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      if ((i == 0 || i == 3) && (j == 0 || j == 3)) continue;
      vec2 place = vec2(i, j) - 1.5;
      ivec2 at = ivec2(floor(gl_FragCoord.xy + place.x * along + place.y * vec2(-along.y, along.x)));
      float rise = (-position.z / tap_depth(at) - 1.0) / falloff, size = abs(rise);
      closed += sign(rise) * min(size, 1.0) / max(size, 1.0);
    }
  return 1.0 - strength * max(closed / float(steps), 0.0);
}
