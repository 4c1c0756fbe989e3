// The lights of a scene's instances in one texture buffer, for passes over lights and for the host's shaders.
#pragma once

#include <vector>

#include "sdk/src/character/scene.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/gl/object.h"

namespace nook::gl {

class LightTexture {
 public:
  explicit LightTexture(Memory* memory) : first_texels_(memory) {}

  static constexpr std::uint32_t no_light = UINT32_MAX;

  // Makes the texture; nothing the second time. Throws Failure.
  void make(Device& device);
  bool made() const { return texture_.name() != 0; }
  // Room for the instances of the scene, so that upload allocates nothing.
  void resize(std::size_t slots) { first_texels_.resize(slots, no_light); }
  // Sends all lights as shaders/character/light_layout.h has them. Throws Failure if OpenGL gives no memory
  // or a texture buffer of it cannot hold them.
  void upload(const Device& device, const Scene& scene);

  // Of the last upload: where the light of the instance in a slot lies, or no_light.
  std::uint32_t first_texel(std::size_t slot) const {
    return slot < first_texels_.size() ? first_texels_[slot] : no_light;
  }
  const Buffer& buffer() const { return buffer_; }
  GLuint texture() const { return texture_.name(); }

 private:
  Buffer buffer_;
  Object texture_;
  Vector<std::uint32_t> first_texels_;  // by slot
};

// A texture that reads the buffer. Binds GL_TEXTURE_BUFFER of unit 0.
Object texture_of(Device& device, const Buffer& buffer, GLenum format, const char* label);

// Returns the text for the host's shaders: shaders/character/host.glsl with everything that it includes.
const char* scene_light_glsl();

}  // namespace nook::gl
