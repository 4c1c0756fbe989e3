#include "bakers/lab/character/pose_space.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "bakers/algebra/symmetric_eigen.h"
#include "bakers/character/pose_sets.h"
#include "bakers/lab/character/cross_validation.h"

namespace nook::lab {
namespace {

using namespace bake;
using Eigen::Index;

// Returns the rotation of a matrix that is rigid or has uniform scale.
Eigen::Matrix3f rotation_part(const Mat3x4& m) {
  Eigen::Matrix3f r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r(i, j) = m.m[4 * i + j];
  const float scale = std::cbrt(std::fabs(r.determinant()));
  return scale > 0 ? Eigen::Matrix3f(r / scale) : Eigen::Matrix3f::Identity();
}

constexpr int starts = 3, most_iterations = 40;

// Draws the initial centres of k-means++ (Arthur & Vassilvitskii 2007). The probability of each next centre
// is proportional to its squared distance to the nearest existing centre.
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

PoseFeatures::PoseFeatures(const SkinnedMesh& mesh, FeatureKind kind) : kind_(kind) {
  for (std::uint32_t bone : posable_joints(mesh)) {
    const std::int32_t parent = mesh.bones[bone].parent;
    // If there are several root bones, the rotations of the others are measured relative to the first root.
    if (parent >= 0 || bone != 0) joints_.push_back({bone, parent >= 0 ? parent : 0});
  }
}

Eigen::RowVectorXf PoseFeatures::of(const Pose& pose) const {
  Eigen::RowVectorXf row(count());
  Eigen::Index next = 0;
  for (const JointPair& joint : joints_) {
    const Eigen::Matrix3f r =
        rotation_part(pose[std::size_t(joint.parent)]).transpose() * rotation_part(pose[joint.bone]);
    if (kind_ == FeatureKind::axis_angle) {
      const Eigen::AngleAxisf turn(r);
      row.segment<3>(next) = (turn.angle() * turn.axis()).transpose();
      next += 3;
    } else {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) row[next++] = r(i, j) - float(i == j);
    }
  }
  return row;
}

BaselineMatrix PoseFeatures::of(std::span<const Pose> poses) const {
  BaselineMatrix rows(Eigen::Index(poses.size()), count());
  tbb::parallel_for(std::size_t(0), poses.size(),
                    [&](std::size_t t) { rows.row(Eigen::Index(t)) = of(poses[t]); });
  return rows;
}

Eigen::RowVectorXf PoseFeatures::moved_share(const SkinnedMesh& mesh) const {
  std::vector<double> moved(mesh.bones.size(), 0.0);
  for (const SkinWeights& w : mesh.weights)
    for (int s = 0; s < SkinWeights::max_bones; ++s) moved[w.bone[s]] += double(w.weight[s]);
  for (std::size_t b = mesh.bones.size(); b-- > 0;)
    if (mesh.bones[b].parent >= 0) moved[std::size_t(mesh.bones[b].parent)] += moved[b];
  Eigen::RowVectorXf scale(count());
  Eigen::Index next = 0;
  for (const JointPair& joint : joints_) {
    // Rotating a joint that moves most of the body has the same effect as rotating the rest of the body in
    // the opposite direction.
    const double share = moved[joint.bone] / double(mesh.vertex_count());
    const float root = std::sqrt(float(std::max(std::min(share, 1 - share), 1e-4)));
    for (Eigen::Index i = 0; i < per_joint(); ++i) scale[next++] = root;
  }
  return scale;
}

PoseSpace::PoseSpace(const SkinnedMesh& mesh, FeatureKind kind, bool by_moved_share,
                     std::span<const Pose> poses, Eigen::Index dimensions)
    : features_(mesh, kind), scale_(features_.moved_share(mesh)) {
  if (!by_moved_share) scale_.setOnes();
  const BaselineMatrix x = scaled(features_.of(poses));
  mean_ = x.colwise().mean();
  const Eigen::MatrixXd centred = (x.rowwise() - mean_).cast<double>();
  const SymmetricEigen eigen = symmetric_eigen(centred.transpose() * centred);
  basis_ = eigen.vectors.rightCols(std::min(dimensions, x.cols())).rowwise().reverse().cast<float>();
  round_to_half(basis_);
}

BaselineMatrix PoseSpace::of(std::span<const Pose> poses) const {
  return (scaled(features_.of(poses)).rowwise() - mean_) * basis_;
}

BaselineMatrix PoseSpace::of(const Pose& pose) const {
  return (scaled(features_.of(pose)) - mean_) * basis_;
}

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
      // A cluster without poses keeps its centre.
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

}  // namespace nook::lab
