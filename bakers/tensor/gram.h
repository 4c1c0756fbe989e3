// Inner products of sub-tensors, and what follows from their eigenvalues: principal components and ranks.
#pragma once

#include <cstddef>

#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {

// Entry (i, j) is <A_<n_i>, B_<n_j>>, or uf_n(A) uf_n(B)^T. A and B may differ in the size of mode n.
// Products are in floats; sums are in floats within blocks and in doubles over blocks.
Eigen::MatrixXd cross_gram(const TensorView& a, const TensorView& b, std::size_t mode);

// uf_n(A) uf_n(A)^T.
Eigen::MatrixXd gram(const TensorView& a, std::size_t mode);

// Returns the eigenvectors of the `count` greatest eigenvalues, the greatest first. Their greatest entry is
// positive, which fixes their signs.
Matrix leading_eigenvectors(const Eigen::MatrixXd& symmetric, std::size_t count);

struct PrincipalComponents {
  Eigen::RowVectorXf mean;
  Matrix basis;  // orthonormal columns, largest variance first
};

// samples: one per row, at least one. Returns `count` components, or as many as the rows have numbers if that
// is fewer.
PrincipalComponents principal_components(const Matrix& samples, std::size_t count);

// Returns the coefficients of the samples, one per row. Distances between rows approximate the distances of
// the samples, up to what the components leave out.
Matrix project(const Matrix& samples, const PrincipalComponents& components);

// Returns for each mode alone, with the others complete, the smallest rank with || A - A^ ||^2 <= share[n] ||
// A ||^2. Ranks are multiples of `multiple`, or I_n. This is the choice of ranks in section 6 of the paper.
// Shares below 1e-6 are below the rounding of floats.
std::vector<std::size_t> ranks_for_error(const TensorView& a, const std::vector<double>& share,
                                         std::size_t multiple = 4);

}  // namespace nook::bake::tensor
