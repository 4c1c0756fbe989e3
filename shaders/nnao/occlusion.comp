// Runs the network as a compute shader, with one thread for each texel of the surface. Groups at the border
// have threads outside the surface.
#include "shaders/nnao/occlusion.glsl"

layout(local_size_x = NOOK_OCCLUSION_GROUP_SIZE, local_size_y = NOOK_OCCLUSION_GROUP_SIZE) in;
#if defined(GL_ES) || NOOK_BENT_NORMALS
layout(rgba8, binding = NOOK_IMAGE_UNIT) writeonly uniform image2D nook_out;  // OpenGL ES 3.1 cannot write rg8
#else
layout(rg8, binding = NOOK_IMAGE_UNIT) writeonly uniform image2D nook_out;
#endif

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (nook_inside(texel, nook_surface_size)) imageStore(nook_out, texel, nook_occlusion(texel));
}
