// The features of a pose that the baselines use: the rotation of each joint against its parent, relative to
// rest.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

enum class FeatureKind : std::uint8_t {
  axis_angle,  // 3 a joint: the logarithm of the rotation, radians
  matrix,      // 9 a joint: its entries minus the identity's
};

// Rows are poses. Row-major, so that a pose is contiguous.
using BaselineMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class PoseFeatures {
 public:
  PoseFeatures(const SkinnedMesh& mesh, FeatureKind kind);

  Eigen::Index count() const { return Eigen::Index(joints_.size()) * per_joint(); }
  Eigen::RowVectorXf of(const Pose& pose) const;
  BaselineMatrix of(std::span<const Pose> poses) const;

  // For each feature, the root of the share of vertices that its joint moves: a metric in which a turned
  // finger is a smaller change of pose than a turned hip.
  Eigen::RowVectorXf moved_share(const SkinnedMesh& mesh) const;

 private:
  struct JointPair {
    std::uint32_t bone;
    std::int32_t parent;  // -1: world
  };
  Eigen::Index per_joint() const { return kind_ == FeatureKind::axis_angle ? 3 : 9; }

  FeatureKind kind_;
  std::vector<JointPair>
      joints_;  // those that move some but not all vertices: turning the others changes no AO
};

}  // namespace nook::bake
