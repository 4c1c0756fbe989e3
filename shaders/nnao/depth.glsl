// The depth of the surface's texels, as depth.frag writes it.
#include "shaders/nnao/frame.glsl"

// The bits of a float, because OpenGL ES 3.0 cannot draw into textures of 32-bit floats. With
// NOOK_NORMAL_SAMPLES there is also the number of the host's sample.
uniform usampler2D nook_depth;

float nook_depth_at(ivec2 texel) {
  return uintBitsToFloat(texelFetch(nook_depth, texel, 0).r);
}

// Returns the depth of the nearest texel of the surface.
float nook_depth_near(ivec2 texel) {
  return nook_depth_at(clamp(texel, ivec2(0), nook_surface_size - 1));
}
