// Eigenvalues of symmetric matrices, for every room that makes or measures data. Only one source uses Eigen's
// solver, because each source that instantiates it takes seconds longer to compile.
#pragma once

#include <Eigen/Core>

namespace nook::bake {

struct SymmetricEigen {
  Eigen::VectorXd values;   // in ascending order
  Eigen::MatrixXd vectors;  // unit columns, in the order of the values
};

// Reads the lower triangle of a square matrix.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& symmetric);

// Returns only the values.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& symmetric);

}  // namespace nook::bake
