#include "sdk/src/probe/convert.h"

#include <algorithm>
#include <array>

#include "sdk/src/probe/harmonics.h"

namespace nook::probe {

void to_harmonics(std::span<const SphericalGaussian> lobes, std::uint32_t order,
                  std::span<Vec3> coefficients) {
  std::fill(coefficients.begin(), coefficients.end(), Vec3{});
  std::array<double, harmonic_count(4)> values;
  for (const SphericalGaussian& g : lobes) {
    evaluate_harmonics(order, double(g.axis.x), double(g.axis.y), double(g.axis.z), values.data());
    const double mass = gaussian_integral(double(g.sharpness));
    const std::array<double, 5> bands = gaussian_bands(double(g.sharpness));
    for (std::uint32_t l = 0, i = 0; l <= order; ++l)
      for (; i < harmonic_count(l); ++i) coefficients[i] += g.amplitude * float(mass * bands[l] * values[i]);
  }
}

}  // namespace nook::probe
