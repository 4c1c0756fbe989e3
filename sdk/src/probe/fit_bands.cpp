#include "sdk/src/probe/fit_bands.h"

#include <cmath>

#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/probe/dense.h"
#include "sdk/src/probe/harmonics.h"

namespace nook::probe {
namespace {

constexpr std::uint32_t highest_band = 2;
static_assert(band_functions == harmonic_count(highest_band));

constexpr double total_light = 1000;

// Returns, for each harmonic, the square of its factor in irradiance, relative to band 0.
constexpr std::array<double, band_functions> harmonic_weights() {
  std::array<double, band_functions> weights{};
  for (std::uint32_t l = 0, i = 0; l <= highest_band; ++l)
    for (; i < harmonic_count(l); ++i) {
      const double share = cosine_band[l] / cosine_band[0];
      weights[i] = share * share * (l == 0 ? total_light : 1);
    }
  return weights;
}
constexpr std::array<double, band_functions> harmonic_weight = harmonic_weights();

}  // namespace

void project_functions(const Basis& basis, double* function) {
  std::array<double, band_functions> values;
  for (std::uint32_t i = 0; i < basis.count; ++i) {
    const Vec3 axis = basis.axis[i];
    const double sharpness = double(basis.sharpness[i]), mass = gaussian_integral(sharpness);
    const std::array<double, 5> bands = gaussian_bands(sharpness);
    evaluate_harmonics(highest_band, double(axis.x), double(axis.y), double(axis.z), values.data());
    for (std::uint32_t l = 0, j = 0; l <= highest_band; ++l)
      for (; j < harmonic_count(l); ++j) function[j * basis.count + i] = mass * bands[l] * values[j];
  }
}

// The minimum is b + K y, where K = G^-1 C^T and (C K + 1 / weights) y = s - C b. The second equation is a
// system of nine equations for y, which is well conditioned for any weight.
void meet_bands(const LightBands& bands, const double* factor, std::uint32_t count, double weight,
                double* b) {
  constexpr std::size_t rows = band_functions;
  std::array<double, rows * max_functions> k;  // K transposed: a row for each harmonic
  std::array<double, rows * rows> system;
  std::array<double, rows* 3> y = bands.light;
  const double* const c = bands.function.data();
  for (std::size_t j = 0; j < rows; ++j) {
    double* const row = k.data() + j * count;
    for (std::size_t i = 0; i < count; ++i) {
      row[i] = c[j * count + i];
      for (std::size_t channel = 0; channel < 3; ++channel) y[3 * j + channel] -= row[i] * b[3 * i + channel];
    }
    cholesky_solve(factor, count, row, 1);
    for (std::size_t other = 0; other <= j; ++other) {
      double sum = other == j ? 1 / (weight * harmonic_weight[j]) : 0;
      for (std::size_t i = 0; i < count; ++i) sum += c[other * count + i] * row[i];
      system[j * rows + other] = sum;
    }
  }
  // If all functions are nearly 0, no digit of the result would be valid.
  if (cholesky(system.data(), rows, 0) < rows) return;
  for (std::size_t channel = 0; channel < 3; ++channel)
    cholesky_solve(system.data(), rows, y.data() + channel, 3);
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t channel = 0; channel < 3; ++channel)
        b[3 * i + channel] += k[j * count + i] * y[3 * j + channel];
}

void add_bands(const LightBands& bands, std::uint32_t count, double weight, double* gram) {
  for (std::size_t j = 0; j < band_functions; ++j) {
    const double* const row = bands.function.data() + j * count;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < count; ++k)
        gram[i * count + k] += weight * harmonic_weight[j] * row[i] * row[k];
  }
}

void add_bands(const LightBands& bands, std::uint32_t count, double weight, std::size_t channel,
               double* moments) {
  for (std::size_t j = 0; j < band_functions; ++j)
    for (std::size_t i = 0; i < count; ++i)
      moments[i] +=
          weight * harmonic_weight[j] * bands.function[j * count + i] * bands.light[3 * j + channel];
}

}  // namespace nook::probe
