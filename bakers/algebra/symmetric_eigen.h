// Eigenvalues and eigenvectors of symmetric matrices. Use these functions instead of Eigen's solver, because
// every source file that instantiates the solver takes seconds longer to compile.
#pragma once

#include <Eigen/Core>

namespace nook::bake {

struct SymmetricEigen {
  Eigen::VectorXd values;   // in ascending order
  Eigen::MatrixXd vectors;  // unit columns, in the order of the values
};

// Reads the lower triangle of a square matrix.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& symmetric);

// Computes only the eigenvalues, in ascending order.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& symmetric);

}  // namespace nook::bake
