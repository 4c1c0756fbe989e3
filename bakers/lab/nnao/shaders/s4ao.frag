#version 330 core
// A version of the S4AO method of Godot's Compatibility renderer (J. Dummer, Godot pull request 109447, 2025).
// We wrote it from the description and the comments of the pull request. It uses a grid of 4 x 4 taps without
// the corners, which is rotated for each pixel. It reads inverse depth but no normals. Inverse depth is linear
// on a plane, so opposite taps cancel each other there. The weight of a tap is our choice: it rises to 1 where
// the difference of inverse depth equals the falloff, and decreases beyond.
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
