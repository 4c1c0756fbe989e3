// The fast step of running averages solves one system for a block of samples.
#include <algorithm>
#include <cmath>

#include "sdk/src/probe/dense.h"
#include "sdk/src/probe/fit.h"

namespace nook::probe {
namespace {

// The coefficients before a block have at least the weight of one sample (least_before), and at least the
// fraction least_share_before of the total weight. At the start, the coefficients are 0 or come from only a
// few samples. The minimum weight prevents large values in the first solutions.
constexpr double least_before = 1;
constexpr double least_share_before = 1.0 / 512;

}  // namespace

// The basis functions are B = L u / sqrt(a), so the sums are multiplied by L / sqrt(a).
void Fit::unwhiten(State state) const {
  if (!whitens_) return;
  const std::uint32_t n = basis_.count;
  const double* const l = factor_.data();
  const double root = 1 / std::sqrt(domain_area(basis_.domain));
  const auto whole_row = [&](double* row) {
    multiply_lower(l, n, row, 1);
    for (std::uint32_t i = 0; i < n; ++i) row[i] *= root;
  };
  double* const gram = state.sums + 3 * std::size_t(padded_);
  for (std::size_t c = 0; c < 3; ++c) whole_row(state.sums + c * padded_);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < i; ++k) gram[k * padded_ + i] = gram[i * padded_ + k];
  for (std::size_t i = 0; i < n; ++i) whole_row(gram + i * padded_);
  for (std::size_t k = 0; k < n; ++k) {
    multiply_lower(l, n, gram + k, padded_);
    for (std::size_t i = 0; i < n; ++i) gram[i * padded_ + k] *= root;
  }
  if (!has_sampled_bands(basis_, settings_)) return;
  for (std::size_t j = 0; j < band_functions; ++j)
    whole_row(state.bands + 3 * std::size_t(band_stride) + j * padded_);
}

void Fit::close_block(State state, const SampleCounts& counts, double* scratch) const {
  const double weight = counts.weight - closed_weight_;
  if (!(weight > 0)) return;
  unwhiten(state);
  const std::size_t n = basis_.count;
  const double total = std::max(counts.weight, counts.expected_weight) + prior_weight_;
  const double before = std::max({total - weight, least_before, total * least_share_before});
  const double prior = before / domain_area(basis_.domain);
  double* const system = scratch;
  double* const change = scratch + n * n;
  const double* const gram = state.sums + 3 * std::size_t(padded_);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k <= i; ++k) system[i * n + k] = system[k * n + i] = gram[i * padded_ + k];
  for (std::size_t c = 0; c < 3; ++c) {
    const double* const b = state.coefficients + c * padded_;
    for (std::size_t i = 0; i < n; ++i) {
      double residual = state.sums[c * padded_ + i];
      for (std::size_t k = 0; k < n; ++k) residual -= system[i * n + k] * b[k];
      change[c * n + i] = residual;
    }
  }
  for (std::size_t i = 0; i < n * n; ++i) system[i] += prior * gram_[i];
  cholesky(system, std::uint32_t(n), 0);
  for (std::size_t c = 0; c < 3; ++c) {
    cholesky_solve(system, std::uint32_t(n), change + c * n, 1);
    for (std::size_t i = 0; i < n; ++i) state.coefficients[c * padded_ + i] += change[c * n + i];
  }
  std::fill_n(state.sums, (3 + n) * padded_, 0.0);
}

}  // namespace nook::probe
