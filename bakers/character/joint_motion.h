// Poses as the motion of each joint relative to its parent, in which poses of one rig can be mixed, blended
// and mirrored.
#pragma once

#include <span>
#include <vector>

#include "bakers/character/rig_anatomy.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// The motion of a joint beyond that of its parent in the body's tree, in rest-space axes.
struct JointMotion {
  Vec3 turn;   // about the joint's rest origin: axis times angle, radians
  Vec3 shift;  // of the joint's origin, metres
  float scale =
      1;  // about the same origin; other scales than uniform ones are rounded to one of equal volume
};

// The axis times the angle of the rotation nearest to the matrix's three rows, made orthonormal in order. The
// quaternion's largest part is found first (Shepperd 1978), so that half turns are exact.
Vec3 turn_of(const Mat3x4& matrix);

std::vector<JointMotion> joint_motions(const SkinnedMesh& mesh, const BodyTree& tree, const Pose& pose);
Pose pose_of(const SkinnedMesh& mesh, const BodyTree& tree, std::span<const JointMotion> motions);

// The motion at a share of the way from one to another: 0 and 1 are the ends, shares beyond them extrapolate.
JointMotion between(const JointMotion& from, const JointMotion& to, float share);

}  // namespace nook::bake
