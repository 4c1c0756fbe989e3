// Draws only the pixels in which the host's depth shows a surface. An occlusion query tells the pass whether
// there are such pixels.
#include "shaders/nnao/host_depth.glsl"

out vec4 nook_out;

void main() {
  if (nook_screen_depth(ivec2(gl_FragCoord.xy) - nook_origin) == nook_no_surface) discard;
  nook_out = vec4(0.0);
}
