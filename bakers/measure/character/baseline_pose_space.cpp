#include "bakers/measure/character/baseline_pose_space.h"

#include <algorithm>

#include "bakers/algebra/symmetric_eigen.h"
#include "bakers/measure/character/baseline_validation.h"

namespace nook::bake {

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

}  // namespace nook::bake
