// Spreads the AO of every fourth pixel over all of them, and computes the result.
#include "shaders/nnao/host_depth.glsl"
#include "shaders/nnao/upsample.glsl"
#include "shaders/world/output.glsl"

uniform int nook_world_counts;

out vec4 nook_out;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) - nook_origin;
  float depth = nook_screen_depth(pixel);
  float open = depth == nook_no_surface ? 1.0 : nook_upsampled(pixel, depth).r;
  nook_out = nook_world_counts == 1 ? vec4(vec3(open), 1.0) : nook_world_result(open, pixel);
}
