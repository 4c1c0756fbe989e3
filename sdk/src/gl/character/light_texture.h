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

// Returns the number of texels of a light; 0 if the instance has no light.
std::uint32_t light_texels(const InstanceLight& light);
// Writes the texels of a light. light_texels returns their number.
void write_light(const Instance& instance, LightTexel* out);

class LightTexture {
 public:
  explicit LightTexture(Memory* memory) : table_(memory), first_texels_(memory) {}

  static constexpr std::uint32_t no_light = UINT32_MAX;

  // Creates the texture in the first call. Throws Failure.
  void make(Device& device);
  bool made() const { return table_.made(); }
  // Reserves memory for the instances of the scene, so that `upload` does not allocate.
  void resize(std::size_t slots) { first_texels_.resize(slots, no_light); }
  // Uploads all lights in the layout of shaders/character/light_layout.h. Throws Failure if OpenGL has no
  // memory or if its texture buffer cannot hold them.
  void upload(Device& device, const Scene& scene);

  // Returns the first texel of the light that the last upload has stored for the instance in a slot, or
  // no_light.
  std::uint32_t first_texel(std::size_t slot) const {
    return slot < first_texels_.size() ? first_texels_[slot] : no_light;
  }
  GLuint texture() const { return table_.texture(); }

 private:
  TexelTable table_;
  Vector<std::uint32_t> first_texels_;  // indexed by slot
};

// Returns the GLSL text for the host's shaders: shaders/character/host.glsl and everything that it includes.
const char* scene_light_glsl();

}  // namespace nook::gl
