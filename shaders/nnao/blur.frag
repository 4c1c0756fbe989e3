// One axis of the blur, at the resolution of the surface.
#include "shaders/nnao/depth.glsl"
#include "shaders/nnao/surface.glsl"
#include "shaders/nnao/blur.glsl"

out float nook_out;

void main() {
  nook_out = nook_blurred(ivec2(gl_FragCoord.xy));
}
