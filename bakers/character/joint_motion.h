// Represents poses as the motion of each joint relative to its parent. In this form, poses of one rig can be
// mixed, blended and mirrored.
#pragma once

#include <span>
#include <vector>

#include "bakers/character/rig_anatomy.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// A joint's motion relative to its parent in the body's tree, in rest space.
struct JointMotion {
  Vec3 turn;        // about the joint's rest origin: axis times angle, radians
  Vec3 shift;       // moves the joint's origin, metres
  float scale = 1;  // about the same origin; a non-uniform scale becomes the uniform scale of equal volume
};

// Returns the rotation nearest to the matrix as axis times angle, in radians. The three rows are made
// orthonormal one after the other. Computes the quaternion's largest component first (Shepperd 1978), so that
// half turns are exact.
Vec3 turn_of(const Mat3x4& matrix);

std::vector<JointMotion> joint_motions(const SkinnedMesh& mesh, const BodyTree& tree, const Pose& pose);
Pose pose_of(const SkinnedMesh& mesh, const BodyTree& tree, std::span<const JointMotion> motions);

// Interpolates between two motions. A share of 0 gives `from`, 1 gives `to`. Shares outside [0, 1]
// extrapolate.
JointMotion between(const JointMotion& from, const JointMotion& to, float share);

}  // namespace nook::bake
