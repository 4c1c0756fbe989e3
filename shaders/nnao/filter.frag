// Runs the filter at the resolution of the surface.
#include "shaders/nnao/frame.glsl"
#include "shaders/nnao/filter.glsl"

#if NOOK_BENT_NORMALS
out vec4 nook_out;
#else
out vec2 nook_out;
#endif

void main() {
  vec4 filtered = nook_filtered(ivec2(gl_FragCoord.xy), nook_surface_size - 1);
#if NOOK_BENT_NORMALS
  nook_out = filtered;
#else
  nook_out = filtered.rg;
#endif
}
