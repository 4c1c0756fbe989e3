// Mode products, equations (2) and (3).
#pragma once

#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {

// A x_n U, U of J_n x I_n.
Tensor mode_product(const TensorView& a, std::size_t mode, const Matrix& u);

// A x_1 U_1 ... x_N U_N; an empty matrix stands for the identity. Modes that shrink most come first; all but
// the first are taken slab by slab of the first, so that nothing between input and result is held whole.
Tensor mode_products(const TensorView& a, const std::vector<Matrix>& u);

// The same with the transposes, A x_1 U_1^T ... x_N U_N^T: what projects on bases.
Tensor project(const TensorView& a, const std::vector<Matrix>& bases);

}  // namespace nook::bake::tensor
