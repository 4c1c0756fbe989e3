#include "sdk/src/gl/character/clip_textures.h"

#include "sdk/src/character/loaded_clips.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/gl/shader_program.h"
#include "sdk/src/gl/state_guard.h"

namespace nook::gl {
namespace {

struct TexelFormat {
  GLint internal;
  GLenum type;
};

void check_size(const Device& device, const ClipTexels& size) {
  GLint most = 0;
  device.gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  if (size.texels > std::uint64_t(ClipTexels::width) * std::uint32_t(most) ||
      ClipTexels::width > std::uint32_t(most))
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the clips are too large for a texture of this OpenGL (got %u x %u texels, need at most %d "
                  "along each side); bake fewer frames",
                  ClipTexels::width, size.height(), most);
}

Object make_texture(Device& device, const ClipTexels& size, TexelFormat format, const void* texels,
                    const char* label) {
  const Functions& gl = device.gl;
  Object texture = Object::make(device, Object::Kind::texture);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, texture.name());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  set_pixel_store(gl, {});
  gl.TexImage2D(GL_TEXTURE_2D, 0, format.internal, GLsizei(ClipTexels::width), GLsizei(size.height()), 0,
                GL_RGBA, format.type, texels);
  device.check("uploading clips");
  device.label(GL_TEXTURE, texture.name(), label);
  return texture;
}

}  // namespace

ClipTextures::ClipTextures(Device& device, const LoadedClips& clips, std::uint32_t mode_count)
    : vec4s_(mode_count / 4) {
  const ClipTexels modes = mode_texels(clips), weights = weight_texels(clips);
  check_size(device, modes);
  check_size(device, weights);
  Vector<std::byte> texels(device.memory);
  texels.resize(static_cast<std::size_t>(modes.bytes()));
  write_mode_texels(clips, texels.data());
  modes_ = make_texture(device, modes, {GL_RGBA8_SNORM, GL_BYTE}, texels.data(), "nook: modes of clips");
  texels.resize(static_cast<std::size_t>(weights.bytes()));
  write_weight_texels(clips, texels.data());
  weights_ =
      make_texture(device, weights, {GL_RGBA16F, GL_HALF_FLOAT}, texels.data(), "nook: weights of clips");
  bytes_ = modes.bytes() + weights.bytes();
}

const char* clips_glsl() {
  return embedded_text("clips/host.glsl");
}

}  // namespace nook::gl
