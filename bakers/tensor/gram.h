// Inner products of sub-tensors. Their eigenvalues give principal components and ranks.
#pragma once

#include <cstddef>

#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {

// Returns uf_n(A) uf_n(B)^T. Entry (i, j) is the inner product <A_<n_i>, B_<n_j>>. The size of mode n may
// differ between A and B. Within a block, products and sums are in floats. Sums over blocks are in doubles.
Eigen::MatrixXd cross_gram(const TensorView& a, const TensorView& b, std::size_t mode);

// Returns uf_n(A) uf_n(A)^T.
Eigen::MatrixXd gram(const TensorView& a, std::size_t mode);

// Returns the eigenvectors of the `count` largest eigenvalues, the largest first. To fix the signs, the entry
// with the largest magnitude in each eigenvector is positive.
Matrix leading_eigenvectors(const Eigen::MatrixXd& symmetric, std::size_t count);

struct PrincipalComponents {
  Eigen::RowVectorXf mean;
  Matrix basis;  // orthonormal columns, largest variance first
};

// `samples` has one sample per row, and at least one row. Returns `count` components, or one per column if
// there are fewer columns.
PrincipalComponents principal_components(const Matrix& samples, std::size_t count);

// Returns the coefficients of the samples, one sample per row. Distances between rows approximate distances
// between samples, except for the part that the components do not represent.
Matrix project(const Matrix& samples, const PrincipalComponents& components);

// Returns a rank for each mode, as in section 6 of the paper: the smallest rank with || A - A^ ||^2 <=
// share[n] || A ||^2 if only this mode is reduced. Ranks are rounded up to multiples of `multiple`, but are
// at most I_n. Shares below 1e-6 are below the rounding error of floats and have no meaning.
std::vector<std::size_t> ranks_for_error(const TensorView& a, const std::vector<double>& share,
                                         std::size_t multiple = 4);

}  // namespace nook::bake::tensor
