// The network's stage as a dispatch: one thread a texel of the surface. The groups at the border reach beyond it.
#include "shaders/nnao/occlusion.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(r8, binding = 0) writeonly uniform image2D nook_out;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (nook_inside(texel, nook_surface_size)) imageStore(nook_out, texel + nook_ao_origin, vec4(nook_occlusion(texel)));
}
