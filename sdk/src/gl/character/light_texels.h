// The light of an instance as the texels that shaders/character/light_layout.h describes.
#pragma once

#include <cstdint>

#include "sdk/src/character/scene.h"

namespace nook::gl {

struct LightTexel {
  float x, y, z, w;
};

// 0 for an instance without light.
std::uint32_t light_texels(const InstanceLight& light);
// Writes as many.
void write_light(const Instance& instance, LightTexel* out);

}  // namespace nook::gl
