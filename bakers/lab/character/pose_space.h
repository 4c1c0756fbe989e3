// Maps poses to points in a space with meaningful distances, and clusters them. The features of a pose are
// the rotations of the joints relative to their parents and to the rest pose.
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"

namespace nook::lab {

enum class FeatureKind : std::uint8_t {
  axis_angle,  // 3 per joint: the logarithm of the rotation, radians
  matrix,      // 9 per joint: the entries of the rotation minus the identity
};

// Rows are poses. Row-major, so that a pose is contiguous.
using BaselineMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class PoseFeatures {
 public:
  PoseFeatures(const bake::SkinnedMesh& mesh, FeatureKind kind);

  Eigen::Index count() const { return Eigen::Index(joints_.size()) * per_joint(); }
  Eigen::RowVectorXf of(const bake::Pose& pose) const;
  BaselineMatrix of(std::span<const bake::Pose> poses) const;

  // Returns for each feature the square root of the share of vertices that the feature's joint moves. If
  // features are scaled by it, the rotation of a finger changes the pose less than the same rotation of a
  // hip.
  Eigen::RowVectorXf moved_share(const bake::SkinnedMesh& mesh) const;

 private:
  struct JointPair {
    std::uint32_t bone;
    std::int32_t parent;  // -1: world
  };
  Eigen::Index per_joint() const { return kind_ == FeatureKind::axis_angle ? 3 : 9; }

  FeatureKind kind_;
  std::vector<JointPair> joints_;  // only joints that move some but not all vertices; others do not affect AO
};

// The space of scaled features, expressed in principal components.
class PoseSpace {
 public:
  // If `by_moved_share` is true, scales each feature by moved_share(). Keeps at most `dimensions` components.
  PoseSpace(const bake::SkinnedMesh& mesh, FeatureKind kind, bool by_moved_share,
            std::span<const bake::Pose> poses, Eigen::Index dimensions);

  Eigen::Index dimensions() const { return basis_.cols(); }
  BaselineMatrix of(std::span<const bake::Pose> poses) const;  // poses x dimensions
  BaselineMatrix of(const bake::Pose& pose) const;             // one row
  std::size_t stored_numbers() const { return std::size_t(basis_.size() + mean_.size()); }

 private:
  BaselineMatrix scaled(const BaselineMatrix& x) const {
    return (x.array().rowwise() * scale_.array()).matrix();
  }

  PoseFeatures features_;
  Eigen::RowVectorXf scale_, mean_;
  BaselineMatrix basis_;  // features x dimensions
};

struct PoseGroups {
  BaselineMatrix centre;         // clusters x features
  double mean_squared_distance;  // from each pose to its nearest centre
};

// Runs Lloyd's iterations from several k-means++ starts and returns the best result. The groups depend only
// on the arguments.
PoseGroups k_means(const BaselineMatrix& features, Eigen::Index clusters, std::uint64_t seed);

// Returns squared distances, as a matrix of poses x clusters.
BaselineMatrix squared_distances(const BaselineMatrix& features, const BaselineMatrix& centres);

}  // namespace nook::lab
