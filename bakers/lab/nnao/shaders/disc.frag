#version 330 core
// A version of N8AO's denoiser, written from its README: eight taps on a disc, which is rotated for each
// pixel and pass. We added one thing: the weight of a tap decreases with its distance from the pixel's plane.
#include "bakers/measure/nnao/shaders/surface.glsl"

uniform sampler2D ao_image;
uniform float disc_px;
uniform float turn;  // rotation of the disc in this pass, radians

out float result;

const int taps = 8;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float centre = texelFetch(ao_image, pixel, 0).r, depth = depth_at(pixel);
  result = centre;
  if (depth == no_surface) return;
  vec3 position = position_at(pixel, depth), normal = normal_at(pixel);
  float reach = 0.1 * pixel_radius(depth).x;
  // Interleaved gradient noise: J. Jimenez, Next generation post processing in Call of Duty, 2014.
  float start = turn + 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  float sum = centre, total = 1.0;
  for (int i = 0; i < taps; ++i) {
    float angle = start + 2.3999632 * float(i), size = disc_px * sqrt((float(i) + 0.5) / float(taps));
    ivec2 at = ivec2(floor(gl_FragCoord.xy + size * vec2(cos(angle), sin(angle))));
    float at_depth = depth_at(at);
    if (at_depth == no_surface) continue;
    float weight = max(1.0 - abs(dot(position_at(at, at_depth) - position, normal)) / reach, 0.0);
    sum += weight * texelFetch(ao_image, at, 0).r;
    total += weight;
  }
  result = sum / total;
}
