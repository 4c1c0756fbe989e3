// Principal components of samples.
#pragma once

#include <cstddef>

#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {

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

}  // namespace nook::bake::tensor
