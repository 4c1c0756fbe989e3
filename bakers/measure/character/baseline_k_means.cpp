#include "bakers/measure/character/baseline_k_means.h"

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace nook::bake {
namespace {

using Eigen::Index;
constexpr int starts = 3, most_iterations = 40;

// Arthur & Vassilvitskii 2007: each next centre is drawn with a probability proportional to its squared
// distance to those there are.
BaselineMatrix draw_centres(const BaselineMatrix& features, Index clusters, std::mt19937_64& bits) {
  const auto uniform = [&] { return double(bits() >> 11) * 0x1p-53; };
  BaselineMatrix centres(clusters, features.cols());
  std::vector<double> nearest(std::size_t(features.rows()), std::numeric_limits<double>::infinity());
  Index pick = Index(uniform() * double(features.rows()));
  for (Index k = 0; k < clusters; ++k) {
    centres.row(k) = features.row(pick);
    double sum = 0;
    for (Index t = 0; t < features.rows(); ++t) {
      double& distance = nearest[std::size_t(t)];
      distance = std::min(distance, double((features.row(t) - centres.row(k)).squaredNorm()));
      sum += distance;
    }
    double left = uniform() * sum;
    pick = 0;
    while (pick + 1 < features.rows() && (left -= nearest[std::size_t(pick)]) >= 0) ++pick;
  }
  return centres;
}

}  // namespace

BaselineMatrix squared_distances(const BaselineMatrix& features, const BaselineMatrix& centres) {
  BaselineMatrix distances(features.rows(), centres.rows());
  for (Index k = 0; k < centres.rows(); ++k)
    distances.col(k) = (features.rowwise() - centres.row(k)).rowwise().squaredNorm();
  return distances;
}

PoseGroups k_means(const BaselineMatrix& features, Index clusters, std::uint64_t seed) {
  std::mt19937_64 bits(seed);
  PoseGroups best;
  best.mean_squared_distance = std::numeric_limits<double>::infinity();
  for (int start = 0; start < starts; ++start) {
    BaselineMatrix centres = draw_centres(features, clusters, bits);
    std::vector<Index> group(std::size_t(features.rows()), -1);
    double total = 0;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      const BaselineMatrix distances = squared_distances(features, centres);
      bool moved = false;
      total = 0;
      BaselineMatrix sum = BaselineMatrix::Zero(clusters, features.cols());
      Eigen::VectorXf members = Eigen::VectorXf::Zero(clusters);
      for (Index t = 0; t < features.rows(); ++t) {
        Index nearest = 0;
        total += double(distances.row(t).minCoeff(&nearest));
        moved |= group[std::size_t(t)] != nearest;
        group[std::size_t(t)] = nearest;
        sum.row(nearest) += features.row(t);
        members[nearest] += 1;
      }
      if (!moved) break;
      // A cluster that lost all its poses keeps its centre.
      for (Index k = 0; k < clusters; ++k)
        if (members[k] > 0) centres.row(k) = sum.row(k) / members[k];
    }
    total /= double(features.rows());
    if (total >= best.mean_squared_distance) continue;
    best.centre.swap(centres);
    best.mean_squared_distance = total;
  }
  return best;
}

}  // namespace nook::bake
