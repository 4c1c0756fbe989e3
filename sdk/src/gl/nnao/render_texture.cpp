#include "sdk/src/gl/nnao/render_texture.h"

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/touched_state.h"

namespace nook::gl {
namespace {

struct Layout {
  GLint internal_format;
  GLenum format, type;
  std::uint64_t bytes;
};

constexpr Layout layout_of(TextureFormat format) {
  switch (format) {
    case TextureFormat::normal:
      return {GL_RG16, GL_RG, GL_UNSIGNED_SHORT, 4};
    case TextureFormat::normal_bits:
      return {GL_RG16UI, GL_RG_INTEGER, GL_UNSIGNED_SHORT, 4};
    case TextureFormat::depth:
      return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4};
    case TextureFormat::sampled_depth:
      return {GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT, 8};
    case TextureFormat::texel_bits:
      return {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 16};
    case TextureFormat::ao_edges:
      return {GL_RG8, GL_RG, GL_UNSIGNED_BYTE, 2};
    case TextureFormat::ao_image:
    case TextureFormat::bent_ao:
      return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4};
    default:
      return {GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1};
  }
}

}  // namespace

std::uint64_t bytes_per_texel(TextureFormat format) {
  return layout_of(format).bytes;
}

// Creates the texture and binds it.
void RenderTexture::begin(Device& device, TextureFormat format, GLenum target, GLuint unit) {
  texture_ = Object::make(device, Object::Kind::texture);
  framebuffer_ = Object::make(device, Object::Kind::framebuffer);
  const Functions& gl = device.gl;
  const GLint filter =
      format == TextureFormat::ao || format == TextureFormat::bent_ao ? GL_LINEAR : GL_NEAREST;
  gl.ActiveTexture(GL_TEXTURE0 + unit);
  gl.BindTexture(target, texture_.name());
  // If a buffer were bound, OpenGL would read the null pointer as an offset into the host's buffer.
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  gl.TexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
  gl.TexParameteri(target, GL_TEXTURE_MIN_FILTER, filter);
  gl.TexParameteri(target, GL_TEXTURE_MAG_FILTER, filter);
  gl.TexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

// Checks that the texture was created and that the bound framebuffer is complete.
void RenderTexture::end(Device& device, const char* label) {
  const GLenum status = device.gl.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Failure(NOOK_ERROR_GL, "a framebuffer with the texture of \"%s\" is not complete (status 0x%04x)",
                  label, status);
}

RenderTexture::RenderTexture(Device& device, TextureFormat format, int width, int height, const char* label) {
  const Functions& gl = device.gl;
  const Layout layout = layout_of(format);
  begin(device, format, GL_TEXTURE_2D, 0);
  // OpenGL ES can bind only immutable textures as images.
  if (gl.TexStorage2D)
    gl.TexStorage2D(GL_TEXTURE_2D, 1, static_cast<GLenum>(layout.internal_format), width, height);
  else
    gl.TexImage2D(GL_TEXTURE_2D, 0, layout.internal_format, width, height, 0, layout.format, layout.type,
                  nullptr);
  device.check("allocating a texture");
  device.label(GL_TEXTURE, texture_.name(), label);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
  gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
  end(device, label);
}

RenderTexture::RenderTexture(Device& device, TextureFormat format, int width, int height, int layers,
                             const char* label) {
  const Functions& gl = device.gl;
  const Layout layout = layout_of(format);
  begin(device, format, GL_TEXTURE_2D_ARRAY, host_depth_unit);
  gl.TexImage3D(GL_TEXTURE_2D_ARRAY, 0, layout.internal_format, width, height, layers, 0, layout.format,
                layout.type, nullptr);
  device.check("allocating a texture array");
  device.label(GL_TEXTURE, texture_.name(), label);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
  attach_layer(gl, texture_.name(), layers - 1);
  end(device, label);
}

void discard_colours(const Functions& gl) {
  const GLenum colours = GL_COLOR_ATTACHMENT0;
  if (gl.InvalidateFramebuffer) gl.InvalidateFramebuffer(GL_DRAW_FRAMEBUFFER, 1, &colours);
}

void attach_layer(const Functions& gl, GLuint texture, int layer) {
  gl.FramebufferTextureLayer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture, 0, layer);
}

}  // namespace nook::gl
