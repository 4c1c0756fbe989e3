// Runs the network as a fragment shader.
#include "shaders/nnao/occlusion.glsl"

#if NOOK_BENT_NORMALS
out vec4 nook_out;
#else
out vec2 nook_out;
#endif

void main() {
  vec4 found = nook_occlusion(ivec2(gl_FragCoord.xy));
#if NOOK_BENT_NORMALS
  nook_out = found;
#else
  nook_out = found.rg;
#endif
}
