#include "sdk/src/gl/character/light_texels.h"

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
  const InstanceLight& light = instance.light;
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

}  // namespace nook::gl
