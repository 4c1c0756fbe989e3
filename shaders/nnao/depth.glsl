// The depth of the surface's texels, as depth.frag writes it.
#include "shaders/nnao/frame.glsl"

// A float's bits, since OpenGL ES 3.0 draws into no texture of 32-bit floats, and with NOOK_NORMAL_SAMPLES the
// number of the host's sample.
uniform usampler2D nook_depth;

float nook_depth_at(ivec2 texel) {
  return uintBitsToFloat(texelFetch(nook_depth, texel, 0).r);
}

// Returns the depth of the nearest texel of the surface.
float nook_depth_near(ivec2 texel) {
  return nook_depth_at(clamp(texel, ivec2(0), nook_surface_size - 1));
}
