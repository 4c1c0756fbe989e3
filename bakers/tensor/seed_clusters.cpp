#include "bakers/tensor/seed_clusters.h"

#include <algorithm>
#include <limits>
#include <random>

#include "bakers/algebra/symmetric_eigen.h"
#include "bakers/tensor/gram.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
constexpr int starts = 8, most_iterations = 100;

struct Groups {
  std::vector<std::uint32_t> group;
  double squared_distance = std::numeric_limits<double>::infinity();
};

// Each point becomes the next centre with a probability proportional to its squared distance from the nearest
// centre so far.
MatrixXd draw_centres(const MatrixXd& points, Index clusters, std::mt19937_64& bits) {
  const auto uniform = [&] { return double(bits() >> 11) * 0x1p-53; };
  MatrixXd centres(clusters, points.cols());
  std::vector<double> nearest(std::size_t(points.rows()), std::numeric_limits<double>::infinity());
  Index pick = Index(uniform() * double(points.rows()));
  for (Index c = 0; c < clusters; ++c) {
    centres.row(c) = points.row(pick);
    double sum = 0;
    for (Index i = 0; i < points.rows(); ++i) {
      double& distance = nearest[std::size_t(i)];
      distance = std::min(distance, (points.row(i) - centres.row(c)).squaredNorm());
      sum += distance;
    }
    if (sum == 0 && c + 1 < clusters)
      throw Failure(
          NOOK_ERROR_INVALID_ARGUMENT,
          "too many clusters for these points (got %zu, need at most %zu, the number of distinct points)",
          std::size_t(clusters), std::size_t(c + 1));
    // Points at distance 0 are never drawn, even if rounding makes `left` reach the end.
    double left = uniform() * sum;
    for (Index i = 0; i < points.rows(); ++i) {
      if (nearest[std::size_t(i)] == 0) continue;
      pick = i;
      if ((left -= nearest[std::size_t(i)]) < 0) break;
    }
  }
  return centres;
}

// Moves one point into each empty group. This is the point farthest from its centre among all groups with
// several points.
void fill_empty(const MatrixXd& points, MatrixXd& centres, Groups& now) {
  std::vector<std::size_t> members(std::size_t(centres.rows()));
  for (std::uint32_t g : now.group) ++members[g];
  for (Index c = 0; c < centres.rows(); ++c) {
    if (members[std::size_t(c)] > 0) continue;
    Index farthest = -1;
    double greatest = -1;
    for (Index i = 0; i < points.rows(); ++i) {
      const std::uint32_t g = now.group[std::size_t(i)];
      const double distance = (points.row(i) - centres.row(Index(g))).squaredNorm();
      if (members[g] < 2 || distance <= greatest) continue;
      greatest = distance;
      farthest = i;
    }
    --members[now.group[std::size_t(farthest)]];
    ++members[std::size_t(c)];
    now.group[std::size_t(farthest)] = std::uint32_t(c);
    centres.row(c) = points.row(farthest);
  }
}

Groups lloyd(const MatrixXd& points, MatrixXd centres) {
  Groups now;
  now.group.assign(std::size_t(points.rows()), 0);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const std::vector<std::uint32_t> before = now.group;
    now.squared_distance = 0;
    for (Index i = 0; i < points.rows(); ++i) {
      Index nearest = 0;
      now.squared_distance += (centres.rowwise() - points.row(i)).rowwise().squaredNorm().minCoeff(&nearest);
      now.group[std::size_t(i)] = std::uint32_t(nearest);
    }
    fill_empty(points, centres, now);
    if (iteration > 0 && now.group == before) break;
    centres.setZero();
    Eigen::VectorXd members = Eigen::VectorXd::Zero(centres.rows());
    for (Index i = 0; i < points.rows(); ++i) {
      centres.row(Index(now.group[std::size_t(i)])) += points.row(i);
      members[Index(now.group[std::size_t(i)])] += 1;
    }
    for (Index c = 0; c < centres.rows(); ++c) centres.row(c) /= members[c];
  }
  return now;
}

}  // namespace

std::vector<std::uint32_t> seed_clusters(const Matrix& points, std::size_t clusters, std::uint64_t seed) {
  if (!points.allFinite())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "one of the points to cluster is not finite");
  if (clusters < 1 || clusters > std::size_t(points.rows()))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the number of clusters is out of range (got %zu, need 1 to %zu, the number of points)",
                  clusters, std::size_t(points.rows()));
  const MatrixXd exact = points.cast<double>();
  std::mt19937_64 bits(seed);
  Groups best;
  for (int start = 0; start < starts; ++start) {
    Groups groups = lloyd(exact, draw_centres(exact, Index(clusters), bits));
    if (groups.squared_distance < best.squared_distance) best = std::move(groups);
  }
  return best.group;
}

Matrix sub_tensor_points(const TensorView& a, std::size_t mode) {
  check_tensor(a);
  if (mode >= a.order())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "mode %zu does not exist in a tensor of order %zu", mode + 1,
                  a.order());
  // uf(A) uf(A)^T = Q L Q^T. So the rows of Q L^(1/2) have the same inner products as the sub-tensors, and
  // therefore the same distances.
  const SymmetricEigen eigen = symmetric_eigen(gram(a, mode));
  const MatrixXd points = eigen.vectors * eigen.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
  return points.cast<float>();
}

}  // namespace nook::bake::tensor
