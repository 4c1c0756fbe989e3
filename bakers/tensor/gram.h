// Inner products of sub-tensors, and what follows from their eigenvalues: principal components and ranks.
#pragma once

#include <cstddef>

#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {

// Entry (i, j) is <A_<n_i>, B_<n_j>>, that is uf_n(A) uf_n(B)^T; A and B may differ in the size of mode n.
// Products of floats, summed in floats within blocks and in doubles over them.
Eigen::MatrixXd cross_gram(const TensorView& a, const TensorView& b, std::size_t mode);

// uf_n(A) uf_n(A)^T.
Eigen::MatrixXd gram(const TensorView& a, std::size_t mode);

// The eigenvectors that belong to the `count` greatest eigenvalues, those first; their signs are fixed by
// their greatest entry, positive.
Matrix leading_eigenvectors(const Eigen::MatrixXd& symmetric, std::size_t count);

struct PrincipalComponents {
  Eigen::RowVectorXf mean;
  Matrix basis;  // orthonormal columns, by falling variance
};

// samples: a row each; at least one. Returns as many components as the rows have numbers if that is fewer
// than count.
PrincipalComponents principal_components(const Matrix& samples, std::size_t count);

// Returns the coefficients of the samples, a row each. Distances between rows are those of the samples, up to
// what the components leave out.
Matrix project(const Matrix& samples, const PrincipalComponents& components);

// Returns, for each mode alone with the others complete, the smallest rank that is a multiple of `multiple`
// (or I_n) at which || A - A^ ||^2 <= share[n] || A ||^2. This is the choice of ranks of section 6 of the
// paper. Shares below 1e-6 are below the rounding of floats.
std::vector<std::size_t> ranks_for_error(const TensorView& a, const std::vector<double>& share,
                                         std::size_t multiple = 4);

}  // namespace nook::bake::tensor
