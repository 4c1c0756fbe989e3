// Coefficients from what a fit has gathered.
#include <algorithm>
#include <array>
#include <cmath>

#include "sdk/src/core/failure.h"
#include "sdk/src/probe/dense.h"
#include "sdk/src/probe/fit.h"
#include "sdk/src/probe/probe.h"

namespace nook::probe {
namespace {

// The samples' Gram matrix is singular before there are as many samples as functions; so much of the true
// one, relative, leaves the smallest of all exact answers, and later nothing that could be seen.
constexpr double regularisation = 1e-8;

float in_range(double value) {
  return float(std::clamp(value, -double(max_coefficient), double(max_coefficient)));
}

}  // namespace

void Fit::read(std::span<Vec3> coefficients) {
  const std::size_t n = basis_.count;
  if (coefficients.size() != n)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "function_count is not the fit's (got %zu, need %zu)",
                  coefficients.size(), n);
  std::array<double, 3 * max_functions> b{};  // function by function
  if (is_running(settings_.method)) {
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < n; ++i)
        b[3 * i + c] = sums_[c * padded_ + i] + double(running_.change[c][i]);
    if (settings_.method == FitMethod::running_average_non_negative) make_non_negative(b.data());
  } else if (counts_.weight > 0) {
    if (settings_.method == FitMethod::naive || settings_.method == FitMethod::moments)
      solve_moments(b.data());
    else
      solve_samples(b.data());
  }
  for (std::size_t i = 0; i < n; ++i)
    coefficients[i] = {in_range(b[3 * i]), in_range(b[3 * i + 1]), in_range(b[3 * i + 2])};
}

void Fit::solve_moments(double* b) {
  const std::uint32_t n = basis_.count;
  const double scale = domain_area(basis_.domain) / counts_.weight;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < n; ++i) {
      b[3 * i + c] = sums_[c * padded_ + i] * scale;
      if (settings_.method == FitMethod::naive) b[3 * i + c] /= row_sum_[i];
    }
    if (settings_.method == FitMethod::moments) cholesky_solve(factor_.data(), n, b + c, 3);
  }
}

void Fit::solve_samples(double* b) {
  const std::uint32_t n = basis_.count;
  double* const gram = scratch_.data();
  double* const rest = gram + std::size_t(n) * n;
  const double prior = regularisation * counts_.weight / domain_area(basis_.domain);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k <= i; ++k)
      gram[i * n + k] = gram[k * n + i] = sums_[(3 + i) * padded_ + k] + prior * gram_[i * n + k];
  if (settings_.method == FitMethod::least_squares) {
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < n; ++i) b[3 * i + c] = sums_[c * padded_ + i];
    cholesky(gram, n, 0);
    for (std::size_t c = 0; c < 3; ++c) cholesky_solve(gram, n, b + c, 3);
    return;
  }
  double* const x = rest + std::size_t(n) * n + 2 * n;
  for (std::size_t c = 0; c < 3; ++c) {
    non_negative_solve(gram, sums_.data() + c * padded_, n, x, rest);
    for (std::size_t i = 0; i < n; ++i) b[3 * i + c] = x[i];
  }
}

// The non-negative coefficients nearest to b in the mean square over the domain. As b tends to least squares,
// they tend to its non-negative form, and are never farther from it than b from least squares. With the plain
// step they are b itself: no sample has left it a negative one.
void Fit::make_non_negative(double* b) {
  const std::uint32_t n = basis_.count;
  bool negative = false;
  for (std::size_t i = 0; i < 3 * std::size_t(n); ++i) negative |= b[i] < 0;
  if (!negative) return;
  double* const target = scratch_.data();
  double* const x = target + n;
  double* const rest = x + n;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < n; ++i) {
      target[i] = 0;
      for (std::size_t k = 0; k < n; ++k) target[i] += gram_[i * n + k] * b[3 * k + c];
    }
    non_negative_solve(gram_.data(), target, n, x, rest);
    for (std::size_t i = 0; i < n; ++i) b[3 * i + c] = x[i];
  }
}

}  // namespace nook::probe
