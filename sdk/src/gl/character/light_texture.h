// Stores the lights of a scene's instances as texels in the layout of shaders/character/light_layout.h, in
// one table for the host's shaders.
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

// Returns the number of texels; 0 for an instance without light.
std::uint32_t light_texels(const InstanceLight& light);
// Writes that many texels.
void write_light(const Instance& instance, LightTexel* out);

class LightTexture {
 public:
  explicit LightTexture(Memory* memory) : table_(memory), first_texels_(memory) {}

  static constexpr std::uint32_t no_light = UINT32_MAX;

  // Makes the texture on the first call. Throws Failure.
  void make(Device& device);
  bool made() const { return table_.made(); }
  // Makes room for the instances of the scene, so that upload does not allocate.
  void resize(std::size_t slots) { first_texels_.resize(slots, no_light); }
  // Sends all lights in the layout of shaders/character/light_layout.h. Throws Failure if OpenGL has no
  // memory or if its texture buffer cannot hold them.
  void upload(Device& device, const Scene& scene);

  // Returns where the last upload put the light of the instance in a slot, or no_light.
  std::uint32_t first_texel(std::size_t slot) const {
    return slot < first_texels_.size() ? first_texels_[slot] : no_light;
  }
  GLuint texture() const { return table_.texture(); }

 private:
  TexelTable table_;
  Vector<std::uint32_t> first_texels_;  // by slot
};

// Returns the text for the host's shaders: shaders/character/host.glsl and everything it includes.
const char* scene_light_glsl();

}  // namespace nook::gl
