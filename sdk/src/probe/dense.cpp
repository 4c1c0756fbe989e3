#include "sdk/src/probe/dense.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "sdk/src/probe/basis.h"

namespace nook::probe {

// Works column by column. The elements below the diagonal of a column do not depend on each other, so the
// processor can compute their sums in parallel.
std::uint32_t cholesky(double* a, std::uint32_t n, double relative) {
  std::array<double, max_functions> diagonal, column;
  for (std::size_t i = 0; i < n; ++i) diagonal[i] = a[i * n + i];
  for (std::size_t k = 0; k < n; ++k) {
    const double pivot = a[k * n + k];
    if (!(pivot > relative * diagonal[k])) return std::uint32_t(k);
    a[k * n + k] = std::sqrt(pivot);
    const double inverse = 1 / a[k * n + k];
    for (std::size_t i = k + 1; i < n; ++i) column[i] = a[i * n + k] *= inverse;
    for (std::size_t i = k + 1; i < n; ++i) {
      double* const row = a + i * n;
      for (std::size_t j = k + 1; j <= i; ++j) row[j] -= column[i] * column[j];
    }
  }
  return n;
}

void multiply_lower(const double* l, std::uint32_t n, double* x, std::uint32_t stride) {
  for (std::size_t i = n; i-- > 0;) {
    double sum = 0;
    for (std::size_t k = 0; k <= i; ++k) sum += l[i * n + k] * x[k * stride];
    x[i * stride] = sum;
  }
}

void cholesky_solve(const double* l, std::uint32_t n, double* x, std::uint32_t stride) {
  for (std::size_t k = 0; k < n; ++k) {
    const double solved = x[k * stride] /= l[k * n + k];
    for (std::size_t i = k + 1; i < n; ++i) x[i * stride] -= l[i * n + k] * solved;
  }
  for (std::size_t k = n; k-- > 0;) {
    const double solved = x[k * stride] /= l[k * n + k];
    for (std::size_t i = 0; i < k; ++i) x[i * stride] -= l[k * n + i] * solved;
  }
}

namespace {

// Solves for the variables in `set`; all others are 0. If a variable depends linearly on earlier variables,
// removes it from the set. Returns the new size of the set.
std::uint32_t solve_subset(const double* g, const double* b, std::uint32_t n, std::uint32_t* set,
                           std::uint32_t size, double* answer, double* scratch) {
  for (;;) {
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t k = 0; k <= i; ++k) scratch[i * size + k] = g[std::size_t(set[i]) * n + set[k]];
      answer[i] = b[set[i]];
    }
    const std::uint32_t dependent = cholesky(scratch, size, 1e-12);
    if (dependent == size) break;
    for (std::uint32_t i = dependent; i + 1 < size; ++i) set[i] = set[i + 1];
    --size;
  }
  cholesky_solve(scratch, size, answer, 1);
  return size;
}

}  // namespace

void non_negative_solve(const double* g, const double* b, std::uint32_t n, double* x, double* scratch) {
  double* answer = scratch + std::size_t(n) * n;
  double* slope = answer + n;
  std::array<std::uint32_t, max_functions> set;
  std::array<bool, max_functions> used{};
  std::uint32_t size = 0;
  double largest = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    x[i] = 0;
    largest = std::fmax(largest, std::abs(b[i]));
  }
  // Each round lowers the error, so no set of variables can occur twice. The limit on rounds is needed only
  // because of rounding errors.
  for (std::uint32_t round = 0; round < 8 * n; ++round) {
    std::uint32_t best = n;
    for (std::uint32_t i = 0; i < n; ++i) {
      slope[i] = b[i];
      for (std::uint32_t k = 0; k < n; ++k) slope[i] -= g[std::size_t(i) * n + k] * x[k];
      if (!used[i] && slope[i] > 1e-12 * largest && (best == n || slope[i] > slope[best])) best = i;
    }
    if (best == n) return;
    set[size++] = best;
    used[best] = true;
    for (;;) {
      // A variable that depends linearly on the variables in use stays at 0 and is not tried again.
      size = solve_subset(g, b, n, set.data(), size, answer, scratch);
      // Moves towards the solution of the subset, but only so far that all variables stay non-negative.
      double step = 1;
      std::uint32_t blocking = size;
      for (std::uint32_t i = 0; i < size; ++i) {
        if (answer[i] > 0) continue;
        const double limit = x[set[i]] / (x[set[i]] - answer[i]);
        if (blocking < size && limit >= step) continue;
        step = limit;
        blocking = i;
      }
      for (std::uint32_t i = 0; i < size; ++i) x[set[i]] += step * (answer[i] - x[set[i]]);
      if (blocking == size) break;
      std::uint32_t kept = 0;
      for (std::uint32_t i = 0; i < size; ++i) {
        const std::uint32_t variable = set[i];
        if (i == blocking || !(x[variable] > 0)) {
          x[variable] = 0;
          used[variable] = false;
        } else {
          set[kept++] = variable;
        }
      }
      size = kept;
      if (size == 0) break;
    }
  }
}

}  // namespace nook::probe
