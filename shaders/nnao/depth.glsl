// Reads the depth of the surface that depth.frag has written.
#include "shaders/nnao/frame.glsl"

// Depth is stored as the bits of a float, because OpenGL ES 3.0 cannot draw into textures of 32-bit floats.
// With NOOK_NORMAL_SAMPLES, the second channel is the index of the host's sample.
uniform usampler2D nook_depth;

float nook_depth_at(ivec2 texel) {
  return uintBitsToFloat(texelFetch(nook_depth, texel, 0).r);
}

// Returns the depth of a texel. Coordinates outside the surface are clamped to the nearest texel.
float nook_depth_near(ivec2 texel) {
  return nook_depth_at(clamp(texel, ivec2(0), nook_surface_size - 1));
}
