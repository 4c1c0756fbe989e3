#include "sdk/src/gl/character/light_texture.h"

#include <algorithm>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/character/light_texels.h"
#include "sdk/src/gl/program.h"

namespace nook::gl {

void LightTexture::make(Device& device) {
  if (!made()) table_.reserve(device, GL_RGBA32F, 256, "nook: lights");
}

void LightTexture::upload(Device& device, const Scene& scene) {
  std::fill(first_texels_.begin(), first_texels_.end(), no_light);
  std::uint64_t texels = 0;
  for (const Instance& instance : scene.instances) texels += light_texels(instance.light);
  if (texels == 0) return;
  if (texels > device.max_texels)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the lights of the scene need %llu texels, a texture buffer of this OpenGL holds %u; light "
                  "fewer instances or use fewer lobes",
                  static_cast<unsigned long long>(texels), device.max_texels);
  table_.write(device, texels, [&](void* memory) {
    std::uint32_t next = 0;
    for (std::size_t slot = 0; slot < scene.instances.size(); ++slot) {
      const Instance& instance = scene.instances[slot];
      if (instance.light.count == 0) continue;
      first_texels_[slot] = next;
      write_light(instance, static_cast<LightTexel*>(memory) + next);
      next += light_texels(instance.light);
    }
  });
}

const char* scene_light_glsl() {
  return embedded_text("character/host.glsl");
}

}  // namespace nook::gl
