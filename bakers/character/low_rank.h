// The best product of few modes and weights for a large matrix.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

namespace nook::bake {

// values ~ modes * weights.transpose(). The modes are orthonormal; the weights of a mode have the length of
// its singular value, and those with the largest come first.
struct LowRank {
  Eigen::MatrixXf modes;        // rows x count
  Eigen::MatrixXf weights;      // columns x count
  std::vector<double> removed;  // the squared singular value of each mode, which it takes from the error
  double total = 0;             // the sum of squares of all values
};

// Finds the leading modes by subspace iteration from random vectors (Halko, Martinsson, Tropp 2011, "Finding
// Structure with Randomness", algorithm 4.4). The same seed gives the same bits on any number of threads.
// There are fewer than `count` modes if the matrix has a smaller side.
LowRank factorise(const Eigen::MatrixXf& values, std::size_t count, std::uint64_t seed);

// The weights of given modes that leave the least squared error: columns x modes.
Eigen::MatrixXf fitted_weights(const Eigen::MatrixXf& values, const Eigen::MatrixXf& modes);

// left * right.transpose(), column by column on all threads.
Eigen::MatrixXf outer_product(const Eigen::MatrixXf& left, const Eigen::MatrixXf& right);

}  // namespace nook::bake
