// Poses as points of a space in which distances mean something.
#pragma once

#include <cstddef>
#include <span>

#include "bakers/measure/character/baseline_features.h"

namespace nook::bake {

// Scaled features in their own principal components.
class PoseSpace {
 public:
  // by_moved_share scales each feature by the root of the share of vertices that its joint moves. At most
  // `dimensions` components are kept.
  PoseSpace(const SkinnedMesh& mesh, FeatureKind kind, bool by_moved_share, std::span<const Pose> poses,
            Eigen::Index dimensions);

  Eigen::Index dimensions() const { return basis_.cols(); }
  BaselineMatrix of(std::span<const Pose> poses) const;  // poses x dimensions
  BaselineMatrix of(const Pose& pose) const;             // one row
  std::size_t stored_numbers() const { return std::size_t(basis_.size() + mean_.size()); }

 private:
  BaselineMatrix scaled(const BaselineMatrix& x) const {
    return (x.array().rowwise() * scale_.array()).matrix();
  }

  PoseFeatures features_;
  Eigen::RowVectorXf scale_, mean_;
  BaselineMatrix basis_;  // features x dimensions
};

}  // namespace nook::bake
