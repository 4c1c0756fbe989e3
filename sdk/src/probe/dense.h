// Small symmetric systems in double precision, row-major, on the caller's memory; nothing is allocated.
#pragma once

#include <cstdint>

namespace nook::probe {

// Replaces the lower triangle of a (n x n, positive definite) by L with a = L L^T. Returns n, or the first
// row whose pivot falls below `relative` of its diagonal: that row depends on the ones before it.
std::uint32_t cholesky(double* a, std::uint32_t n, double relative);

// x becomes L x, in place; element i of x lies at x[i * stride].
void multiply_lower(const double* l, std::uint32_t n, double* x, std::uint32_t stride);

// Solves L L^T x = b in place; element i of x lies at x[i * stride].
void cholesky_solve(const double* l, std::uint32_t n, double* x, std::uint32_t stride);

// Finds the x >= 0 that minimises x^T g x - 2 b^T x (C. Lawson & R. Hanson's active sets). scratch: n * n + 2
// n doubles.
void non_negative_solve(const double* g, const double* b, std::uint32_t n, double* x, double* scratch);

}  // namespace nook::probe
