#include "sdk/src/probe/fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/probe/dense.h"
#include "sdk/src/probe/fit_kernels.h"

namespace nook::probe {

const FitKernels* fit_kernels(Isa isa) {
  if (!isa_available(isa)) return nullptr;
#define NOOK_ISA_ENTRY(name, value, built, runs) \
  if constexpr (built)                           \
    if (isa == Isa::name) return &isa_##name::fit_kernels();
#include "sdk/src/core/isa_list.inl"
  return nullptr;
}

namespace {

constexpr float padding_sharpness = 1e4f;
// If a pivot of the Gram matrix is below this fraction of its diagonal element, the fit is rejected: its
// coefficients would be nothing but rounding errors.
constexpr double smallest_pivot = 1e-9;
// If a pivot is below this fraction, float sums are too inexact, and the fit uses orthonormal functions.
constexpr double least_plain_pivot = 0.01;

void check_settings(const Basis& basis, const FitSettings& settings) {
  check_fits("growing_samples", settings.growing_samples, settings.growing_samples >= 0, "0 or more");
  const bool signed_only = settings.method == FitMethod::running_average_original ||
                           settings.method == FitMethod::running_average_non_negative ||
                           settings.method == FitMethod::non_negative_least_squares;
  if (signed_only && basis.kind == BasisKind::harmonics)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "method %d needs functions that are never negative, but harmonics can be negative; use a "
                  "running average, moments or least squares",
                  int(settings.method));
}

// The rows of `floats_`, in order. lobes_ and running_ point to these rows. The whitening matrix is stored
// after them.
enum Row : std::uint32_t { axis_x, axis_y, axis_z, sharpness, true_square, inverse_mean, rows };

}  // namespace

Fit::Fit(const Basis& basis, const FitSettings& settings, Memory* memory)
    : basis_(basis), settings_(settings), kernels_(fit_kernels(choose_isa(settings.isa))) {
  check_basis(basis, NOOK_ERROR_INVALID_ARGUMENT);
  check_settings(basis, settings);
  const std::uint32_t n = basis.count;
  padded_ = std::uint32_t(padded_count(n));
  floats_ = AlignedArray<float>(std::size_t(rows) * padded_ + whitening_size(n), memory);
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
  running_.true_square = row(true_square);
  running_.inverse_mean = row(inverse_mean);
  whitening_ = row(rows);
  state_ = AlignedArray<double>(state_size(), memory);
  spare_ = AlignedArray<double>(state_size(), memory);
  // Whitening processes four rows at a time, and the plain step processes padded rows, so there are more rows
  // than functions.
  values_ = AlignedArray<float>(std::size_t(padded_) * sample_chunk, memory);
  recent_ = AlignedArray<RecentSamples>(1, memory);
  samples_ = AlignedArray<SampleColumns>(1, memory);
  std::fill_n(samples_[0].growth, SampleColumns::capacity, 1.0f);
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
                  "function %u is nearly a linear combination of the %u functions before it; use fewer or "
                  "sharper lobes",
                  dependent, dependent);
  float* const constants = floats_.data();
  for (std::uint32_t i = 0; i < padded_; ++i) {
    const bool real = i < n;
    constants[true_square * padded_ + i] = real ? float(gram[std::size_t(i) * n + i] / area) : 1.0f;
    constants[inverse_mean * padded_ + i] = real && integrals[i] > 0 ? float(area / integrals[i]) : 0.0f;
  }
  for (std::uint32_t f = 0; f < n; ++f) {
    for (std::uint32_t k = 0; k < n; ++k) row_sum_[f] += gram[std::size_t(f) * n + k];
    if (basis_.kind == BasisKind::harmonics) row_sum_[f] = gram[std::size_t(f) * n + f];
    const std::size_t diagonal = std::size_t(f) * n + f;
    whitens_ |= factor_[diagonal] * factor_[diagonal] < least_plain_pivot * gram[diagonal];
  }
  prepare_whitening(constants + std::size_t(rows) * padded_);
}

// Computes the whitening matrix sqrt(a) L^-1, column by column.
void Fit::prepare_whitening(float* whitening) const {
  const std::uint32_t n = basis_.count;
  std::array<double, max_functions> column;
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = j; i < n; ++i) {
      double sum = i == j ? std::sqrt(domain_area(basis_.domain)) : 0;
      for (std::uint32_t k = j; k < i; ++k) sum -= factor_[std::size_t(i) * n + k] * column[k];
      column[i] = sum / factor_[std::size_t(i) * n + i];
      const std::uint32_t block = i / 4;
      whitening[8 * block * (block + 1) + 4 * j + i % 4] = float(column[i]);
    }
  }
}

bool Fit::is_block() const {
  return settings_.step == Step::fast && (settings_.method == FitMethod::running_average ||
                                          settings_.method == FitMethod::running_average_non_negative);
}

std::size_t Fit::state_size() const {
  const std::size_t bands = 3 * std::size_t(band_stride) + std::size_t(band_functions) * padded_;
  return std::size_t(7 + basis_.count) * padded_ + (meets_bands(basis_, settings_) ? bands : 0);
}

Fit::State Fit::state_at(double* numbers) const {
  State state;
  state.sums = numbers;
  state.coefficients = state.sums + std::size_t(3 + basis_.count) * padded_;
  state.square = state.coefficients + 3 * std::size_t(padded_);
  state.bands = meets_bands(basis_, settings_) ? state.square + padded_ : nullptr;
  return state;
}

}  // namespace nook::probe
