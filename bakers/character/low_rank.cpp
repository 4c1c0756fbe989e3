#include "bakers/character/low_rank.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "bakers/algebra/symmetric_eigen.h"
#include "bakers/raytrace/random.h"

namespace nook::bake {
namespace {

// Blocks of fixed size give the same bits on any number of threads.
constexpr Eigen::Index block = 256;

template <class Body>
void for_blocks(Eigen::Index count, const Body& body) {
  tbb::parallel_for(Eigen::Index(0), (count + block - 1) / block,
                    [&](Eigen::Index b) { body(b * block, std::min(block, count - b * block)); });
}

// values * x
Eigen::MatrixXf product(const Eigen::MatrixXf& values, const Eigen::MatrixXf& x) {
  Eigen::MatrixXf out(values.rows(), x.cols());
  for_blocks(values.rows(), [&](Eigen::Index first, Eigen::Index count) {
    out.middleRows(first, count).noalias() = values.middleRows(first, count) * x;
  });
  return out;
}

// values.transpose() * x
Eigen::MatrixXf transposed_product(const Eigen::MatrixXf& values, const Eigen::MatrixXf& x) {
  Eigen::MatrixXf out(values.cols(), x.cols());
  for_blocks(values.cols(), [&](Eigen::Index first, Eigen::Index count) {
    out.middleRows(first, count).noalias() = values.middleCols(first, count).transpose() * x;
  });
  return out;
}

Eigen::MatrixXf orthonormal(const Eigen::MatrixXf& columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXf> qr(columns);
  return qr.householderQ() * Eigen::MatrixXf::Identity(columns.rows(), columns.cols());
}

}  // namespace

LowRank factorise(const Eigen::MatrixXf& values, std::size_t count, std::uint64_t seed) {
  // Vectors beyond the modes that are kept, and rounds, by which the last modes converge.
  constexpr Eigen::Index spare = 16;
  constexpr int rounds = 3;
  const Eigen::Index smaller = std::min(values.rows(), values.cols());
  const Eigen::Index kept = std::min(Eigen::Index(count), smaller), used = std::min(kept + spare, smaller);
  Random random(seed);
  Eigen::MatrixXf start(values.cols(), used);
  for (Eigen::Index c = 0; c < used; ++c)
    for (Eigen::Index r = 0; r < start.rows(); ++r) start(r, c) = random.normal();
  Eigen::MatrixXf basis = orthonormal(product(values, start));
  for (int round = 0; round < rounds; ++round)
    basis = orthonormal(product(values, orthonormal(transposed_product(values, basis))));
  const Eigen::MatrixXf weights = transposed_product(values, basis);

  const Eigen::MatrixXd wide = weights.cast<double>();
  const SymmetricEigen eigen = symmetric_eigen(wide.transpose() * wide);
  const Eigen::MatrixXf turn = eigen.vectors.rowwise().reverse().leftCols(kept).cast<float>();
  LowRank result;
  result.modes = basis * turn;
  result.weights = weights * turn;
  for (Eigen::Index k = 0; k < kept; ++k) result.removed.push_back(std::max(eigen.values[used - 1 - k], 0.0));
  for (Eigen::Index c = 0; c < values.cols(); ++c) result.total += values.col(c).cast<double>().squaredNorm();
  return result;
}

Eigen::MatrixXf fitted_weights(const Eigen::MatrixXf& values, const Eigen::MatrixXf& modes) {
  const Eigen::MatrixXd wide = modes.cast<double>();
  Eigen::MatrixXd gram = wide.transpose() * wide;
  // Modes that are zero, where the matrix has a lower rank, keep zero weights.
  gram.diagonal().array() += 1e-9 * gram.trace() / double(gram.rows()) + 1e-30;
  const Eigen::MatrixXd right = transposed_product(values, modes).cast<double>();
  return gram.ldlt().solve(right.transpose()).transpose().cast<float>();
}

Eigen::MatrixXf outer_product(const Eigen::MatrixXf& left, const Eigen::MatrixXf& right) {
  Eigen::MatrixXf out(left.rows(), right.rows());
  for_blocks(right.rows(), [&](Eigen::Index first, Eigen::Index count) {
    out.middleCols(first, count).noalias() = left * right.middleRows(first, count).transpose();
  });
  return out;
}

}  // namespace nook::bake
