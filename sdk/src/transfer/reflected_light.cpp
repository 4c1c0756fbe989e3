#include "sdk/src/transfer/reflected_light.h"

#include <numbers>

namespace nook::transfer {

ReflectedBands reflected_light(const Response& response, std::span<const float> amplitudes,
                               std::uint32_t bounces, Memory* memory) {
  ReflectedBands out{};
  if (bounces == 0) return out;
  Vector<Vec3> axes(response.lobes, Vec3{}, memory);
  lobe_axes(axes);
  const auto light = bands_of_lobes(axes, sharpness_of(response.lobes), amplitudes);
  const Vec3 share = response.reflectance;
  Vec3 reflected = share * (1 / std::numbers::pi_v<float>);
  for (std::uint32_t b = 0; b < bounces; ++b) {
    for (std::uint32_t k = 0; k < band_count; ++k)
      out[b * band_count + k] = {light[k].x * reflected.x, light[k].y * reflected.y,
                                 light[k].z * reflected.z};
    reflected = {reflected.x * share.x, reflected.y * share.y, reflected.z * share.z};
  }
  return out;
}

}  // namespace nook::transfer
