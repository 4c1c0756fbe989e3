// Computes coefficients from the sums of a fit.

#include <algorithm>
#include <array>
#include <cmath>

#include "sdk/src/core/failure.h"
#include "sdk/src/probe/dense.h"
#include "sdk/src/probe/fit.h"
#include "sdk/src/probe/gloss.h"
#include "sdk/src/probe/probe.h"

namespace nook::probe {
namespace {

// As regularisation, this fraction of the true Gram matrix is added to the Gram matrix of the samples. The
// fraction is so small that its effect is invisible.
constexpr double regularisation = 1e-8;
// The samples determine the coefficients if each pivot of their Gram matrix is at least this fraction of the
// corresponding pivot of the true Gram matrix. Rounding errors of float sums, 1e-6 of the diagonal, are below
// this limit.
constexpr double least_share = 1e-4;

// Returns 0 if the value exceeds the range of floats. This happens if radiance is huge and some lobes are
// nearly linear combinations of others.
float in_range(double value) {
  if (std::isnan(value)) return 0;
  return float(std::clamp(value, -double(max_coefficient), double(max_coefficient)));
}

// Returns true if each pivot of a Cholesky factor is at least `share` times the corresponding pivot of
// `other`.
bool has_pivots(const double* factor, const double* other, std::uint32_t n, double share) {
  for (std::size_t i = 0; i < n; ++i) {
    const double pivot = factor[i * n + i], need = other[i * n + i];
    if (!(pivot * pivot >= share * need * need)) return false;
  }
  return true;
}

}  // namespace

void Fit::read(std::span<Vec3> coefficients) {
  const std::size_t n = basis_.count;
  if (coefficients.size() != n)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "function_count differs from the fit's number of functions (got %zu, need %zu)",
                  coefficients.size(), n);
  std::array<double, 3 * max_functions> b{};  // function by function
  take_recent();
  const Gathered gathered = present(room());
  if (!is_block()) unwhiten(gathered.state);
  if (is_running(settings_.method)) {
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < n; ++i) b[3 * i + c] = gathered.state.coefficients[c * padded_ + i];
    if (settings_.method == FitMethod::running_average_non_negative)
      make_non_negative(gathered, b.data());
    else if (gathered.state.bands)
      meet_bands(light_bands(gathered), factor_.data(), basis_.count, band_weight(), b.data());
  } else if (gathered.counts.weight > 0) {
    if (settings_.method == FitMethod::naive || settings_.method == FitMethod::moments)
      solve_moments(gathered, b.data());
    else
      solve_samples(gathered, b.data());
  }
  for (std::size_t i = 0; i < n; ++i)
    coefficients[i] = {in_range(b[3 * i]), in_range(b[3 * i + 1]), in_range(b[3 * i + 2])};
}

void Fit::solve_moments(const Gathered& gathered, double* b) {
  const std::uint32_t n = basis_.count;
  const double scale = domain_area(basis_.domain) / gathered.counts.weight;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < n; ++i) {
      b[3 * i + c] = gathered.state.sums[c * padded_ + i] * scale;
      if (settings_.method == FitMethod::naive) b[3 * i + c] /= row_sum_[i];
    }
    if (settings_.method == FitMethod::moments) cholesky_solve(factor_.data(), n, b + c, 3);
  }
  if (gathered.state.bands) meet_bands(light_bands(gathered), factor_.data(), n, band_weight(), b);
}

// Computes the Gram matrix of the samples and its Cholesky factor. With fewer samples than functions, or with
// few different directions, this matrix is singular, apart from rounding errors. Then a larger fraction of
// the true matrix is added, so that the solution is close to the smallest coefficients that match the
// samples.
void Fit::factor_samples(const Gathered& gathered, double scale, double* gram, double* factor) const {
  const std::uint32_t n = basis_.count;
  const auto factor_with = [&](double prior) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k <= i; ++k)
        gram[i * n + k] = gram[k * n + i] =
            gathered.state.sums[(3 + i) * padded_ + k] + prior * scale * gram_[i * n + k];
    std::copy_n(gram, std::size_t(n) * n, factor);
    return cholesky(factor, n, 0) == n;
  };
  if (factor_with(regularisation) && has_pivots(factor, factor_.data(), n, least_share * scale)) return;
  // Without rounding errors, the sum would pass this test, because adding the samples' matrix can only
  // increase the pivots.
  for (double prior = least_share; prior < 1; prior *= 10)
    if (factor_with(prior) && has_pivots(factor, factor_.data(), n, 0.9 * prior * scale)) return;
  factor_with(1);
}

void Fit::solve_samples(const Gathered& gathered, double* b) {
  const std::uint32_t n = basis_.count;
  double* const gram = scratch_.data();
  double* const rest = gram + std::size_t(n) * n;
  const double scale =
      gathered.counts.weight / domain_area(basis_.domain);  // converts the samples' sums to integrals
  factor_samples(gathered, scale, gram, rest);
  if (settings_.method == FitMethod::least_squares) {
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < n; ++i) b[3 * i + c] = gathered.state.sums[c * padded_ + i];
    for (std::size_t c = 0; c < 3; ++c) cholesky_solve(rest, n, b + c, 3);
    if (gathered.state.bands) meet_bands(light_bands(gathered), rest, n, band_weight() * scale, b);
    return;
  }
  double* const x = rest + std::size_t(n) * n + 2 * n;
  double* const target = x + n;
  const LightBands bands = !gathered.state.bands ? LightBands{} : light_bands(gathered);
  if (gathered.state.bands) add_bands(bands, n, band_weight() * scale, gram);
  for (std::size_t c = 0; c < 3; ++c) {
    std::copy_n(gathered.state.sums + c * padded_, n, target);
    if (gathered.state.bands) add_bands(bands, n, band_weight() * scale, c, target);
    non_negative_solve(gram, target, n, x, rest);
    for (std::size_t i = 0; i < n; ++i) b[3 * i + c] = x[i];
  }
}

// Replaces b by non-negative coefficients. They minimise the sum of two terms: the mean squared difference
// from b over the domain, and the difference from the light's bands. If b converges to least squares, the
// result converges to non-negative least squares. With the plain step and without bands, b does not change,
// because the plain step never leaves a negative coefficient.
void Fit::make_non_negative(const Gathered& gathered, double* b) {
  const std::uint32_t n = basis_.count;
  bool negative = false;
  for (std::size_t i = 0; i < 3 * std::size_t(n); ++i) negative |= b[i] < 0;
  if (!negative && !gathered.state.bands) return;
  double* const gram = scratch_.data();
  double* const target = gram + std::size_t(n) * n;
  double* const x = target + n;
  double* const rest = x + n;
  const LightBands bands = !gathered.state.bands ? LightBands{} : light_bands(gathered);
  std::copy(gram_.begin(), gram_.end(), gram);
  if (gathered.state.bands) add_bands(bands, n, band_weight(), gram);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < n; ++i) {
      target[i] = 0;
      for (std::size_t k = 0; k < n; ++k) target[i] += gram_[i * n + k] * b[3 * k + c];
    }
    if (gathered.state.bands) add_bands(bands, n, band_weight(), c, target);
    non_negative_solve(gram, target, n, x, rest);
    for (std::size_t i = 0; i < n; ++i) b[3 * i + c] = x[i];
  }
}

// Computes the moments, function by function as RGB, and returns the Gram matrix that belongs to them. If the
// method sums the Gram matrix of its samples, returns that matrix. A running average keeps only coefficients,
// so its moments are computed from the light that the coefficients represent.
const double* Fit::gloss_moments(const Gathered& gathered, double* moments) {
  const std::size_t n = basis_.count;
  const double scale = domain_area(basis_.domain) / gathered.counts.weight;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < n; ++i) {
      double& moment = moments[3 * i + c];
      if (!is_running(settings_.method)) {
        moment = gathered.state.sums[c * padded_ + i] * scale;
        continue;
      }
      moment = 0;
      for (std::size_t k = 0; k < n; ++k)
        moment += gram_[i * n + k] * gathered.state.coefficients[c * padded_ + k];
    }
  if (settings_.method != FitMethod::least_squares &&
      settings_.method != FitMethod::non_negative_least_squares)
    return gram_.data();
  double* const gram = scratch_.data();
  factor_samples(gathered, 1 / scale, gram, gram + n * n);
  for (std::size_t i = 0; i < n * n; ++i) gram[i] *= scale;
  return gram;
}

void Fit::read_gloss(std::span<Vec3> amplitudes) {
  const std::uint32_t n = basis_.count;
  if (amplitudes.size() != n || basis_.kind != BasisKind::gaussians)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "gloss amplitudes need a basis of lobes (got %zu amplitudes of basis %d, need %u of basis 0)",
        amplitudes.size(), int(basis_.kind), n);
  std::fill(amplitudes.begin(), amplitudes.end(), Vec3{});
  take_recent();
  const Gathered gathered = present(room());
  if (!(gathered.counts.weight > 0)) return;
  if (!is_block()) unwhiten(gathered.state);
  std::array<double, 3 * max_functions> moments, b;
  const double* const gram = gloss_moments(gathered, moments.data());
  double* const scratch = scratch_.data() + std::size_t(n) * n;
  for (std::size_t c = 0; c < 3; ++c) fit_gloss(gram, moments.data() + c, n, 3, b.data() + c, scratch);
  for (std::size_t i = 0; i < n; ++i)
    amplitudes[i] = {in_range(b[3 * i]), in_range(b[3 * i + 1]), in_range(b[3 * i + 2])};
}

double Fit::band_weight() const {
  const bool non_negative = settings_.method == FitMethod::running_average_non_negative ||
                            settings_.method == FitMethod::non_negative_least_squares;
  return non_negative || basis_.domain == Domain::hemisphere ? soft_bands : exact_bands;
}

// Returns the integrals of the light times each harmonic, and of each function times each harmonic over the
// same directions. Below the horizon of a hemisphere, the light is treated as black.
LightBands Fit::light_bands(const Gathered& gathered) const {
  LightBands bands;
  const std::uint32_t n = basis_.count;
  const double weight =
      is_running(settings_.method)
          ? std::max(gathered.counts.weight, gathered.counts.expected_weight) + prior_weight_
          : gathered.counts.weight;
  const double scale = weight > 0 ? domain_area(basis_.domain) / weight : 0;
  for (std::size_t j = 0; j < band_functions; ++j)
    for (std::size_t c = 0; c < 3; ++c)
      bands.light[3 * j + c] = scale * gathered.state.bands[c * band_stride + j];
  if (!has_sampled_bands(basis_, settings_)) {
    project_functions(basis_, bands.function.data());
    return bands;
  }
  const double* const sums = gathered.state.bands + 3 * std::size_t(band_stride);
  for (std::size_t j = 0; j < band_functions; ++j)
    for (std::size_t i = 0; i < n; ++i) bands.function[j * n + i] = scale * sums[j * padded_ + i];
  return bands;
}

Vector<double> solution_map(const Basis& basis, Constraint constraint, Memory* memory) {
  const std::uint32_t n = basis.count, columns = n + band_functions;
  Vector<double> factor = basis_gram(basis, memory);
  cholesky(factor.data(), n, 0);
  LightBands bands;
  project_functions(basis, bands.function.data());
  Vector<double> map(std::size_t(n) * columns, 0.0, memory);
  // The three channels of a fit are independent. So one solve can compute three columns of the matrix. For
  // this, the moments of each channel are a unit vector, which selects one column.
  std::array<double, 3 * max_functions> b;
  for (std::uint32_t first = 0; first < columns; first += 3) {
    const std::uint32_t end = std::min(first + 3, columns);
    b.fill(0);
    bands.light.fill(0);
    for (std::uint32_t column = first; column < end; ++column) {
      const std::uint32_t channel = column - first;
      if (column >= n)
        bands.light[3 * (column - n) + channel] = 1;
      else
        b[3 * column + channel] = 1;
    }
    for (std::uint32_t channel = 0; channel < 3; ++channel)
      cholesky_solve(factor.data(), n, b.data() + channel, 3);
    if (constraint == Constraint::bands) meet_bands(bands, factor.data(), n, exact_bands, b.data());
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t column = first; column < end; ++column)
        map[std::size_t(i) * columns + column] = b[3 * i + column - first];
  }
  return map;
}

}  // namespace nook::probe
