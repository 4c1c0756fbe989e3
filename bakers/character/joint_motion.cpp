#include "bakers/character/joint_motion.h"

#include <algorithm>
#include <cmath>

#include "bakers/character/rig_anatomy.h"
#include "bakers/character/rotation.h"

namespace nook::bake {
namespace {

Vec3 row(const Mat3x4& a, int i) {
  return {a.m[4 * i], a.m[4 * i + 1], a.m[4 * i + 2]};
}

// Returns the edge length of a cube with the same volume as the transformed unit cube.
float volume_scale(const Mat3x4& a) {
  return std::cbrt(std::fabs(dot(row(a, 0), cross(row(a, 1), row(a, 2)))));
}

Mat3x4 inverse_affine(const Mat3x4& a) {
  const Vec3 r0 = row(a, 0), r1 = row(a, 1), r2 = row(a, 2);
  const float volume = dot(r0, cross(r1, r2));
  const float inverse = volume != 0 ? 1 / volume : 0;
  const Vec3 c0 = inverse * cross(r1, r2), c1 = inverse * cross(r2, r0), c2 = inverse * cross(r0, r1);
  const Vec3 t{a.m[3], a.m[7], a.m[11]};
  Mat3x4 result{{c0.x, c1.x, c2.x, 0, c0.y, c1.y, c2.y, 0, c0.z, c1.z, c2.z, 0}};
  const Vec3 back = transform_vector(result, t);
  result.m[3] = -back.x;
  result.m[7] = -back.y;
  result.m[11] = -back.z;
  return result;
}

}  // namespace

Vec3 turn_of(const Mat3x4& a) {
  const Vec3 x = normalised(row(a, 0));
  const Vec3 y = normalised(row(a, 1) - dot(row(a, 1), x) * x);
  const Vec3 z = cross(x, y);
  const float trace = x.x + y.y + z.z;
  float w;
  Vec3 v;
  if (trace >= x.x && trace >= y.y && trace >= z.z) {
    w = 1 + trace;
    v = {z.y - y.z, x.z - z.x, y.x - x.y};
  } else if (x.x >= y.y && x.x >= z.z) {
    w = z.y - y.z;
    v = {1 + x.x - y.y - z.z, x.y + y.x, x.z + z.x};
  } else if (y.y >= z.z) {
    w = x.z - z.x;
    v = {x.y + y.x, 1 + y.y - x.x - z.z, y.z + z.y};
  } else {
    w = y.x - x.y;
    v = {x.z + z.x, y.z + z.y, 1 + z.z - x.x - y.y};
  }
  if (w < 0) {
    w = -w;
    v = -v;
  }
  const float sine = length(v);
  return sine > 0 ? 2 * std::atan2(sine, w) / sine * v : Vec3{};
}

std::vector<JointMotion> joint_motions(const SkinnedMesh& mesh, const BodyTree& tree, const Pose& pose) {
  std::vector<JointMotion> motions(pose.size());
  for (std::size_t b = 0; b < pose.size(); ++b) {
    const std::int32_t parent = tree.parent[b];
    const Mat3x4 local = parent >= 0 ? inverse_affine(pose[std::size_t(parent)]) * pose[b] : pose[b];
    const Vec3 origin = joint_origin(mesh.bones[b]);
    motions[b] = {turn_of(local), transform_point(local, origin) - origin, volume_scale(local)};
  }
  return motions;
}

Pose pose_of(const SkinnedMesh& mesh, const BodyTree& tree, std::span<const JointMotion> motions) {
  Pose pose(motions.size());
  for (const std::uint32_t b : tree.order) {
    const Vec3 origin = joint_origin(mesh.bones[b]);
    Mat3x4 local = rotation(motions[b].turn);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) local.m[4 * i + j] *= motions[b].scale;
    const Vec3 move = origin + motions[b].shift - transform_vector(local, origin);
    local.m[3] = move.x;
    local.m[7] = move.y;
    local.m[11] = move.z;
    const std::int32_t parent = tree.parent[b];
    pose[b] = parent >= 0 ? pose[std::size_t(parent)] * local : local;
  }
  return pose;
}

JointMotion between(const JointMotion& from, const JointMotion& to, float share) {
  const Mat3x4 start = rotation(from.turn);
  const Vec3 step = turn_of(inverse_rigid(start) * rotation(to.turn));
  return {turn_of(start * rotation(share * step)), from.shift + share * (to.shift - from.shift),
          from.scale * std::pow(to.scale / from.scale, share)};
}

}  // namespace nook::bake
