// Solves small symmetric linear systems in double precision. Matrices are row-major. The functions work in
// the caller's memory and allocate nothing.
#pragma once

#include <cstdint>

namespace nook::probe {

// Replaces the lower triangle of `a` (n x n, positive definite) by its Cholesky factor L, where a = L L^T.
// Returns n if this succeeds. Otherwise returns the index of the first row whose pivot is below `relative`
// times its diagonal element; this row depends linearly on the rows before it.
std::uint32_t cholesky(double* a, std::uint32_t n, double relative);

// Computes x = L x in place. Element i of x is stored at x[i * stride].
void multiply_lower(const double* l, std::uint32_t n, double* x, std::uint32_t stride);

// Solves L L^T x = b in place: pass b in x. Element i of x is stored at x[i * stride].
void cholesky_solve(const double* l, std::uint32_t n, double* x, std::uint32_t stride);

// Finds the x >= 0 that minimises x^T g x - 2 b^T x, by the active-set method of C. Lawson & R. Hanson.
// `scratch` must have room for n * n + 2 n doubles.
void non_negative_solve(const double* g, const double* b, std::uint32_t n, double* x, double* scratch);

}  // namespace nook::probe
