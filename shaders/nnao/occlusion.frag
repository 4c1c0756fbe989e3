// The network as a draw.
#include "shaders/nnao/occlusion.glsl"

out vec2 nook_out;

void main() {
  nook_out = nook_occlusion(ivec2(gl_FragCoord.xy));
}
