// One axis of the blur, at the resolution of the surface.
#include "nnao/depth.glsl"
#include "nnao/surface.glsl"
#include "nnao/blur.glsl"

out float nook_out;

void main() {
  nook_out = nook_blurred(ivec2(gl_FragCoord.xy));
}
