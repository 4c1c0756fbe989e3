#include "bakers/material/directions.h"

#include <cmath>
#include <numbers>

#include "sdk/src/core/failure.h"

namespace nook::bake::material {

Vec3 direction_from_angles(float tilt_deg, float azimuth_deg) {
  const float degree = std::numbers::pi_v<float> / 180;
  const float tilt = tilt_deg * degree, azimuth = azimuth_deg * degree;
  return {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)};
}

std::vector<Vec3> spiral_directions(std::uint32_t count, float max_tilt_deg) {
  if (count < 4) throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "too few directions (got %u, need 4)", count);
  if (!(max_tilt_deg > 0 && max_tilt_deg < 90))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the largest tilt is %g degrees; it must lie between 0 and 90",
                  double(max_tilt_deg));
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  const double lowest = std::cos(double(max_tilt_deg) * std::numbers::pi / 180);
  std::vector<Vec3> directions(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    // Equal steps in z are equal solid angles (Archimedes).
    const double z = 1 - (1 - lowest) * i / (count - 1);
    const double radius = std::sqrt(std::max(0.0, 1 - z * z)), azimuth = golden_angle * i;
    directions[i] = {float(radius * std::cos(azimuth)), float(radius * std::sin(azimuth)), float(z)};
  }
  return directions;
}

}  // namespace nook::bake::material
