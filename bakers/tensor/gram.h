// Inner products of sub-tensors.
#pragma once

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

}  // namespace nook::bake::tensor
