// The filter at the resolution of the surface.
#include "shaders/nnao/frame.glsl"
#include "shaders/nnao/filter.glsl"

out vec2 nook_out;

void main() {
  nook_out = nook_filtered(ivec2(gl_FragCoord.xy), nook_surface_size - 1);
}
