// The lights of a scene's instances as the texels that shaders/character/light_layout.h describes, and in one
// table of them for the host's shaders.
#pragma once

#include <cstdint>
#include <vector>

#include "sdk/src/character/scene.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/gl/texel_table.h"

namespace nook::gl {

struct LightTexel {
  float x, y, z, w;
};

// 0 for an instance without light.
std::uint32_t light_texels(const InstanceLight& light);
// Writes as many.
void write_light(const Instance& instance, LightTexel* out);

class LightTexture {
 public:
  explicit LightTexture(Memory* memory) : table_(memory), first_texels_(memory) {}

  static constexpr std::uint32_t no_light = UINT32_MAX;

  // Makes the texture; nothing the second time. Throws Failure.
  void make(Device& device);
  bool made() const { return table_.made(); }
  // Room for the instances of the scene, so that upload allocates nothing.
  void resize(std::size_t slots) { first_texels_.resize(slots, no_light); }
  // Sends all lights as shaders/character/light_layout.h has them. Throws Failure if OpenGL gives no memory
  // or a texture buffer of it cannot hold them.
  void upload(Device& device, const Scene& scene);

  // Of the last upload: where the light of the instance in a slot lies, or no_light.
  std::uint32_t first_texel(std::size_t slot) const {
    return slot < first_texels_.size() ? first_texels_[slot] : no_light;
  }
  GLuint texture() const { return table_.texture(); }

 private:
  TexelTable table_;
  Vector<std::uint32_t> first_texels_;  // by slot
};

// Returns the text for the host's shaders: shaders/character/host.glsl with everything that it includes.
const char* scene_light_glsl();

}  // namespace nook::gl
