#include "bakers/measure/character/baseline_features.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <cmath>

#include "bakers/character/pose_sets.h"

namespace nook::bake {
namespace {

// The rotation in a rigid or uniformly scaled matrix.
Eigen::Matrix3f rotation_part(const Mat3x4& m) {
  Eigen::Matrix3f r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r(i, j) = m.m[4 * i + j];
  const float scale = std::cbrt(std::fabs(r.determinant()));
  return scale > 0 ? Eigen::Matrix3f(r / scale) : Eigen::Matrix3f::Identity();
}

}  // namespace

PoseFeatures::PoseFeatures(const SkinnedMesh& mesh, FeatureKind kind) : kind_(kind) {
  for (std::uint32_t bone : posable_joints(mesh)) {
    const std::int32_t parent = mesh.bones[bone].parent;
    // Several roots: they turn against the first one.
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
    // A joint that turns most of the body turns the rest of it the other way.
    const double share = moved[joint.bone] / double(mesh.vertex_count());
    const float root = std::sqrt(float(std::max(std::min(share, 1 - share), 1e-4)));
    for (Eigen::Index i = 0; i < per_joint(); ++i) scale[next++] = root;
  }
  return scale;
}

}  // namespace nook::bake
