#include "probe/convert.h"

#include <array>
#include <cmath>

#include "probe/harmonics.h"

namespace nook::probe {
namespace {

// i_l(x) / i_0(x) of the modified spherical Bessel functions, by their series: for small x, where the
// recurrence loses its digits.
double band_by_series(double x, std::uint32_t l) {
  const auto series = [x](std::uint32_t order) {
    double term = 1, sum = 1;
    for (int k = 1; k < 24; ++k) sum += term *= x * x / 2 / (k * (2.0 * order + 2 * k + 1));
    return sum;
  };
  double lead = 1;
  for (std::uint32_t i = 1; i <= l; ++i) lead *= x / (2 * i + 1);
  return lead * series(l) / series(0);
}

}  // namespace

double gaussian_band(double sharpness, std::uint32_t l) {
  if (l == 0) return 1;
  if (sharpness < 4) return band_by_series(sharpness, l);
  double before = 1, band = 1 - gaussian_spread(sharpness);
  for (std::uint32_t i = 1; i < l; ++i) {
    const double next = before - (2 * i + 1) / sharpness * band;
    before = band;
    band = next;
  }
  return band;
}

void to_harmonics(std::span<const SphericalGaussian> lobes, std::uint32_t order,
                  std::span<Vec3> coefficients) {
  for (Vec3& c : coefficients) c = {};
  std::array<double, harmonic_count(4)> values;
  for (const SphericalGaussian& g : lobes) {
    evaluate_harmonics(order, double(g.axis.x), double(g.axis.y), double(g.axis.z), values.data());
    const double mass = gaussian_integral(double(g.sharpness));
    for (std::uint32_t l = 0, i = 0; l <= order; ++l) {
      const double band = mass * gaussian_band(double(g.sharpness), l);
      for (; i < harmonic_count(l); ++i) coefficients[i] += g.amplitude * float(band * values[i]);
    }
  }
}

}  // namespace nook::probe
