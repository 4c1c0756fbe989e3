#include "sdk/src/transfer/lobes.h"

#include <cmath>
#include <numbers>

namespace nook::transfer {

void lobe_axes(std::span<Vec3> axes) {
  constexpr double golden_angle = std::numbers::pi * (3 - 2.23606797749978969641);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double z = 1 - 2 * (double(i) + 0.5) / double(axes.size());
    const double r = std::sqrt(1 - z * z), azimuth = golden_angle * double(i);
    axes[i] = {float(r * std::cos(azimuth)), float(r * std::sin(azimuth)), float(z)};
  }
}

}  // namespace nook::transfer
