#include "sdk/src/probe/fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sdk/src/core/failure.h"
#include "sdk/src/probe/dense.h"
#include "sdk/src/probe/harmonics.h"

namespace nook::probe {
namespace {

constexpr std::uint32_t chunk = 64;          // samples that go through the kernels at once
constexpr std::uint32_t settle_every = 256;  // samples
// Weights are 1 in the mean. Up to so many samples the weight so far counts as at least their number: a first
// sample of tiny weight and huge radiance, as a sampler by luminance draws, would otherwise be all that a
// running average knows, and what it makes of that would not be forgotten for thousands of samples.
constexpr double first_weight = 256;
constexpr float max_radiance = 1e18f;  // sums of squares stay finite
constexpr float padding_sharpness = 1e4f;
// A pivot of the Gram matrix below this share of its diagonal: coefficients would be rounding alone.
constexpr double smallest_pivot = 1e-9;

void check_settings(const Basis& basis, const FitSettings& settings) {
  if (!(settings.growing_samples >= 0) || !std::isfinite(settings.growing_samples))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "growing_samples is out of range (got %g, need 0 or more)",
                  double(settings.growing_samples));
  const bool signed_only = settings.method == FitMethod::running_average_original ||
                           settings.method == FitMethod::running_average_non_negative ||
                           settings.method == FitMethod::non_negative_least_squares;
  if (signed_only && basis.kind == BasisKind::harmonics)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "method %d needs functions that are never negative, which harmonics are; use a running "
                  "average, moments or least squares",
                  int(settings.method));
}

// Rows of floats in fit order: what lobes_ and running_ point to.
enum Row : std::uint32_t {
  axis_x,
  axis_y,
  axis_z,
  sharpness,
  values,
  changes = values + 3,
  square = changes + 3,
  true_square,
  inverse_mean,
  dual
};

}  // namespace

Fit::Fit(const Basis& basis, const FitSettings& settings, Memory* memory)
    : basis_(basis), settings_(settings), kernels_(fit_kernels(choose_isa(settings.isa))) {
  check_basis(basis, NOOK_ERROR_INVALID_ARGUMENT);
  check_settings(basis, settings);
  const std::uint32_t n = basis.count;
  padded_ = std::uint32_t(padded_count(n));
  floats_ = AlignedArray<float>(std::size_t(dual + n + (n & 1u)) * padded_, memory);
  const auto row = [&](std::uint32_t index) { return floats_.data() + std::size_t(index) * padded_; };
  for (std::uint32_t i = 0; i < n; ++i) {
    row(axis_x)[i] = basis.axis[i].x;
    row(axis_y)[i] = basis.axis[i].y;
    row(axis_z)[i] = basis.axis[i].z;
    row(sharpness)[i] = basis.sharpness[i];
  }
  std::fill(row(sharpness) + n, row(sharpness) + padded_, padding_sharpness);
  lobes_ = {row(axis_x), row(axis_y), row(axis_z), row(sharpness), padded_};
  running_.count = n;
  running_.padded = padded_;
  for (std::uint32_t c = 0; c < 3; ++c) {
    running_.value[c] = row(values + c);
    running_.change[c] = row(changes + c);
  }
  running_.square = row(square);
  running_.true_square = row(true_square);
  running_.inverse_mean = row(inverse_mean);
  running_.dual = row(dual);
  sums_ = AlignedArray<double>(std::size_t(3 + n) * padded_, memory);
  if (meets_bands(basis, settings))
    bands_ =
        AlignedArray<double>(3 * std::size_t(band_stride) + std::size_t(band_functions) * padded_, memory);
  scratch_ = AlignedArray<double>(2 * std::size_t(n) * n + 6 * std::size_t(n), memory);
  prepare_gram(memory);
}

void Fit::prepare_gram(Memory* memory) {
  const std::uint32_t n = basis_.count;
  const double area = domain_area(basis_.domain);
  const Vector<double> gram = basis_gram(basis_, memory);
  const Vector<double> integrals = basis_integrals(basis_, memory);
  gram_ = AlignedArray<double>(gram.size(), memory);
  factor_ = AlignedArray<double>(gram.size(), memory);
  row_sum_ = AlignedArray<double>(n, memory);
  std::copy(gram.begin(), gram.end(), gram_.begin());
  std::copy(gram.begin(), gram.end(), factor_.begin());
  const std::uint32_t dependent = cholesky(factor_.data(), n, smallest_pivot);
  if (dependent < n)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "function %u is nearly a mixture of the %u before it; use fewer or sharper lobes",
                  dependent, dependent);
  float* const rows = floats_.data();
  for (std::uint32_t i = 0; i < padded_; ++i) {
    const bool real = i < n;
    rows[true_square * padded_ + i] = real ? float(gram[std::size_t(i) * n + i] / area) : 1.0f;
    rows[inverse_mean * padded_ + i] = real && integrals[i] > 0 ? float(area / integrals[i]) : 0.0f;
  }
  for (std::uint32_t f = 0; f < n; ++f) {
    double* column = scratch_.data();
    std::fill_n(column, n, 0.0);
    column[f] = area;
    cholesky_solve(factor_.data(), n, column, 1);
    for (std::uint32_t i = 0; i < n; ++i) rows[(dual + f) * padded_ + i] = float(column[i]);
    for (std::uint32_t k = 0; k < n; ++k) row_sum_[f] += gram[std::size_t(f) * n + k];
    if (basis_.kind == BasisKind::harmonics) row_sum_[f] = gram[std::size_t(f) * n + f];
  }
}

std::uint32_t Fit::filter(const float* directions, const float* radiance, const float* weights,
                          std::uint32_t count, Sample* samples) {
  std::uint32_t kept = 0;
  const bool hemisphere = basis_.domain == Domain::hemisphere;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 d{directions[3 * i], directions[3 * i + 1], directions[3 * i + 2]};
    const Vec3 v{radiance[3 * i], radiance[3 * i + 1], radiance[3 * i + 2]};
    float w = weights ? weights[i] : 1.0f;
    const float length2 = dot(d, d);
    // Comparisons that NaN fails.
    if (!(std::abs(length2 - 1) <= 2e-3f) || (hemisphere && !(dot(d, basis_.up) >= 0))) {
      ++counts_.bad_direction;
      continue;
    }
    if (!(std::abs(v.x) <= max_radiance && std::abs(v.y) <= max_radiance && std::abs(v.z) <= max_radiance)) {
      ++counts_.bad_radiance;
      continue;
    }
    if (!(w >= 0 && w <= max_radiance)) {
      ++counts_.bad_weight;
      continue;
    }
    ++counts_.used;
    const double growth = settings_.growing_samples > 0
                              ? -std::expm1(-double(counts_.used) / double(settings_.growing_samples))
                              : 1;
    w *= float(growth);
    if (w > 0) counts_.expected_weight = std::min(counts_.expected_weight + growth, first_weight);
    counts_.weight += double(w);
    counts_.radiance[0] += double(w) * double(v.x);
    counts_.radiance[1] += double(w) * double(v.y);
    counts_.radiance[2] += double(w) * double(v.z);
    const float total = float(std::max(counts_.weight, counts_.expected_weight) + prior_weight_);
    if (!(w > 0 && total > 0)) continue;
    // Two Newton steps from 1 make a nearly unit vector unit.
    const float first = 1.5f - 0.5f * length2, unit = first * (1.5f - 0.5f * length2 * first * first);
    samples[kept++] = {{d.x * unit, d.y * unit, d.z * unit}, w, {v.x, v.y, v.z}, total};
  }
  return kept;
}

void Fit::add_samples(const float* directions, const float* radiance, const float* weights,
                      std::size_t count) {
  std::array<Sample, chunk> samples;
  while (count > 0) {
    // A chunk never straddles the places where running averages settle, so that calls may be cut anywhere.
    const std::uint32_t room = std::min(chunk, settle_every - unsettled_);
    const auto now = std::uint32_t(std::min<std::size_t>(count, room));
    const std::uint32_t kept = filter(directions, radiance, weights, now, samples.data());
    fit_samples(samples.data(), kept);
    unsettled_ += kept;
    if (unsettled_ == settle_every) settle();
    directions += 3 * now;
    radiance += 3 * now;
    if (weights) weights += now;
    count -= now;
  }
}

void Fit::fit_samples(const Sample* samples, std::uint32_t count) {
  alignas(64) std::array<float, std::size_t(chunk) * max_functions> values;
  if (basis_.kind == BasisKind::gaussians) {
    kernels_->gaussian_values(lobes_, samples, count, values.data());
  } else {
    for (std::uint32_t k = 0; k < count; ++k) {
      const float* d = samples[k].direction;
      float* row = values.data() + std::size_t(k) * padded_;
      evaluate_basis(basis_, Vec3{d[0], d[1], d[2]}, row);
      std::fill(row + basis_.count, row + padded_, 0.0f);
    }
  }
  step(samples, values.data(), count);
  if (bands_.size() > 0) sum_bands(samples, values.data(), count);
}

// Harmonic by harmonic: the light's moment, and for forms with a Gram matrix of their samples the sum of its
// products with every function, so that a light which lobes make exactly leaves no noise in the bands.
void Fit::sum_bands(const Sample* samples, const float* values, std::uint32_t count) {
  alignas(64) std::array<float, std::size_t(chunk) * band_stride> harmonics{};
  for (std::uint32_t k = 0; k < count; ++k) {
    const float* const d = samples[k].direction;
    evaluate_harmonics(2, d[0], d[1], d[2], harmonics.data() + std::size_t(k) * band_stride);
  }
  kernels_->sum_moments(samples, harmonics.data(), count, band_stride, bands_.data());
  if (!has_sampled_bands(basis_, settings_)) return;
  // Three harmonics at a time take the place of red, green and blue.
  std::array<Sample, chunk> weighted;
  std::copy_n(samples, count, weighted.begin());
  for (std::uint32_t first = 0; first < band_functions; first += 3) {
    for (std::uint32_t k = 0; k < count; ++k)
      std::copy_n(harmonics.data() + std::size_t(k) * band_stride + first, 3, weighted[k].radiance);
    kernels_->sum_moments(weighted.data(), values, count, padded_,
                          bands_.data() + 3 * std::size_t(band_stride) + std::size_t(first) * padded_);
  }
}

void Fit::step(const Sample* samples, const float* values, std::uint32_t count) {
  const bool fast = settings_.step == Step::fast;
  switch (settings_.method) {
    case FitMethod::running_average:
    case FitMethod::running_average_non_negative:
      if (fast) return kernels_->step_fast(running_, samples, values, count);
      return kernels_->step_plain(running_, samples, values, count,
                                  settings_.denominator == Denominator::lockstep,
                                  settings_.method == FitMethod::running_average_non_negative);
    case FitMethod::running_average_original:
      return kernels_->step_original(running_, samples, values, count);
    case FitMethod::least_squares:
    case FitMethod::non_negative_least_squares:
      kernels_->sum_gram(samples, values, count, basis_.count, padded_, sums_.data() + 3 * padded_);
      [[fallthrough]];
    case FitMethod::naive:
    case FitMethod::moments:
      return kernels_->sum_moments(samples, values, count, padded_, sums_.data());
  }
}

void Fit::settle() {
  unsettled_ = 0;
  if (!is_running(settings_.method)) return;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < padded_; ++i) {
      double& settled = sums_[c * padded_ + i];
      settled += double(running_.change[c][i]);
      running_.value[c][i] = float(settled);
      running_.change[c][i] = 0;
    }
}

}  // namespace nook::probe
