#include "sdk/src/probe/axes.h"

#include <cmath>
#include <numbers>

namespace nook::probe {
namespace {

// Returns a point of the spiral. The heights of the points go from 1 down to `lowest`. Each point is at the
// middle height of a zone, and all zones have equal area.
Vec3 on_spiral(std::size_t index, std::size_t count, double lowest) {
  constexpr double golden_angle = std::numbers::pi * (3 - 2.23606797749978969641);
  const double z = 1 - (1 - lowest) * (double(index) + 0.5) / double(count);
  const double r = std::sqrt(1 - z * z), azimuth = golden_angle * double(index);
  return {float(r * std::cos(azimuth)), float(r * std::sin(azimuth)), float(z)};
}

}  // namespace

Frame frame_round(Vec3 z) {
  // Starts from a coordinate axis that is not close to z.
  const Vec3 away = std::abs(z.x) < 0.6f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 y = normalised(cross(z, away));
  return {cross(y, z), y, z};
}

void vogel_sphere(std::span<Vec3> axes) {
  for (std::size_t i = 0; i < axes.size(); ++i) axes[i] = on_spiral(i, axes.size(), -1);
}

void vogel_hemisphere(Vec3 up, std::span<Vec3> axes) {
  const Frame frame = frame_round(up);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Vec3 a = on_spiral(i, axes.size(), 0);
    axes[i] = normalised(frame.x * a.x + frame.y * a.y + frame.z * a.z);
  }
}

}  // namespace nook::probe
