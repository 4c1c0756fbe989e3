#include "sdk/src/gl/character/light_texture.h"

#include <algorithm>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/shader_program.h"
#include "shaders/character/light_layout.h"

namespace nook::gl {
namespace {

LightTexel texel(Vec3 v, float w) {
  return {v.x, v.y, v.z, w};
}

}  // namespace

std::uint32_t light_texels(const InstanceLight& light) {
  return light.count ? NOOK_LIGHT_LOBES + NOOK_LIGHT_LOBE_TEXELS * light.count : 0;
}

// Writes a light in the layout of light_layout.h.
void write_light(const Instance& instance, LightTexel* out) {
  const InstanceLight& light = instance.light();
  const LightBands& bands = light.bands;
  out[NOOK_LIGHT_HEAD] = {float(light.count), instance.input.ground.normal.x, instance.input.ground.normal.y,
                          instance.input.ground.normal.z};
  out[NOOK_LIGHT_DARKEST] = texel(light.darkest, instance.plan.ground_sphere.radius > 0 ? 1.0f : 0.0f);
  out[NOOK_LIGHT_SCALAR] = texel(bands.scalar, 0);
  const auto write = [&](std::uint32_t first, std::span<const Vec3> values) {
    for (const Vec3 v : values) out[first++] = texel(v, 0);
  };
  write(NOOK_LIGHT_VECTOR, bands.vector);
  write(NOOK_LIGHT_STRAIGHT, std::span(bands.tensor).first(3));
  write(NOOK_LIGHT_MIXED, std::span(bands.tensor).subspan(3));
  for (std::uint32_t i = 0; i < light.count; ++i) {
    const LightLobe& lobe = light.lobes[i];
    LightTexel* const at = out + NOOK_LIGHT_LOBES + NOOK_LIGHT_LOBE_TEXELS * i;
    at[0] = texel(lobe.sharpness > 0 ? lobe.vector * (1 / lobe.sharpness) : Vec3{0, 1, 0}, lobe.sharpness);
    at[1] = texel(lobe.amplitude, lobe.above);
  }
}

void LightTexture::make(Device& device) {
  if (!made()) table_.reserve(device, GL_RGBA32F, 256, "nook: lights");
}

void LightTexture::upload(Device& device, const Scene& scene) {
  std::fill(first_texels_.begin(), first_texels_.end(), no_light);
  std::uint64_t texels = 0;
  for (const Instance& instance : scene.instances) texels += light_texels(instance.light());
  if (texels == 0) return;
  if (texels > device.max_texels)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the lights of the scene need %llu texels, but a texture buffer of this OpenGL holds %u; "
                  "light fewer instances or use fewer lobes",
                  static_cast<unsigned long long>(texels), device.max_texels);
  table_.write(device, texels, [&](void* memory) {
    std::uint32_t next = 0;
    for (std::size_t slot = 0; slot < scene.instances.size(); ++slot) {
      const Instance& instance = scene.instances[slot];
      if (instance.light().count == 0) continue;
      first_texels_[slot] = next;
      write_light(instance, static_cast<LightTexel*>(memory) + next);
      next += light_texels(instance.light());
    }
  });
}

const char* scene_light_glsl() {
  return embedded_text("character/host.glsl");
}

}  // namespace nook::gl
