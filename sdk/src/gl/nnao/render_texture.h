// The textures that the screen-space pass draws into.
#pragma once

#include "sdk/src/gl/object.h"

namespace nook::gl {

enum class TextureFormat {
  ao,             // GL_R8
  bent_ao,        // GL_RGBA8, filtered linearly as ao is
  ao_edges,       // GL_RG8
  ao_image,       // GL_RGBA8, for bent normals, and for compute shaders that cannot write GL_RG8
  depth,          // GL_R32UI, the bits of a float
  sampled_depth,  // GL_RG32UI, the bits of a float and a sample index
  normal,         // GL_RG16
  normal_bits,    // GL_RG16UI, for contexts that cannot draw into GL_RG16
  texel_bits,     // GL_RGBA32UI, the bits of four floats
};
std::uint64_t bytes_per_texel(TextureFormat format);

// A texture without mipmaps, and a framebuffer that draws into it.
class RenderTexture {
 public:
  RenderTexture() = default;
  // Binds unit 0, the draw framebuffer and the pixel unpack buffer. The contents are undefined. Throws
  // Failure.
  RenderTexture(Device& device, TextureFormat format, int width, int height, const char* label);
  // Creates a texture array. Its last layer is attached to the framebuffer. Binds unit 1 instead of unit 0.
  RenderTexture(Device& device, TextureFormat format, int width, int height, int layers, const char* label);

  GLuint texture() const { return texture_.name(); }
  GLuint framebuffer() const { return framebuffer_.name(); }

 private:
  void begin(Device& device, TextureFormat format, GLenum target, GLuint unit);
  void end(Device& device, const char* label);

  Object texture_, framebuffer_;
};

// Tells OpenGL that the current colours of the bound draw framebuffer are not needed, so that a tile-based
// GPU does not load them. Does nothing if OpenGL does not have the function.
void discard_colours(const Functions& gl);

// Attaches a layer to the bound draw framebuffer.
void attach_layer(const Functions& gl, GLuint texture, int layer);

}  // namespace nook::gl
