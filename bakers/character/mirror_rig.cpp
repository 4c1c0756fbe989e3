#include "bakers/character/mirror_rig.h"

#include <algorithm>
#include <cmath>

#include "bakers/character/joint_origin.h"

namespace nook::bake {
namespace {

constexpr std::uint32_t nobody = ~0u;

struct Plane {
  Vec3 normal;
  float offset = 0;
};

Vec3 reflected(Vec3 direction, Vec3 normal) {
  return direction - 2 * dot(direction, normal) * normal;
}

Vec3 reflected_point(Vec3 point, const Plane& plane) {
  return point - 2 * (dot(point, plane.normal) - plane.offset) * plane.normal;
}

// A joint with all below it, by which joints at one place differ.
struct Branch {
  Vec3 middle;  // of the joint and all below it, metres
  float count = 1;
};

std::vector<Branch> branches(const SkinnedMesh& mesh, const BodyTree& tree) {
  std::vector<Branch> branch;
  for (const Bone& bone : mesh.bones) branch.push_back({joint_origin(bone), 1});
  for (std::size_t i = tree.order.size(); i-- > 0;) {
    Branch& own = branch[tree.order[i]];
    if (tree.parent[tree.order[i]] >= 0) {
      Branch& above = branch[std::size_t(tree.parent[tree.order[i]])];
      above.middle += own.middle;
      above.count += own.count;
    }
    own.middle = (1 / own.count) * own.middle;
  }
  return branch;
}

// Pairs joints from the roots down; empty where one finds no twin.
std::vector<std::uint32_t> twins(const SkinnedMesh& mesh, const BodyTree& tree, const Plane& plane,
                                 float tolerance_m) {
  const std::size_t count = mesh.bones.size();
  const std::vector<Branch> branch = branches(mesh, tree);
  std::vector<std::uint32_t> twin(count, nobody);
  for (const std::uint32_t b : tree.order) {
    if (twin[b] != nobody) continue;
    const Vec3 image = reflected_point(joint_origin(mesh.bones[b]), plane);
    const Vec3 image_middle = reflected_point(branch[b].middle, plane);
    const std::int32_t parent = tree.parent[b];
    const std::int32_t twin_parent = parent >= 0 ? std::int32_t(twin[std::size_t(parent)]) : -1;
    float nearest = INFINITY;
    for (const std::uint32_t other : tree.order) {
      if (twin[other] != nobody || tree.parent[other] != twin_parent ||
          branch[other].count != branch[b].count)
        continue;
      const float distance = length(joint_origin(mesh.bones[other]) - image);
      const float all = distance + length(branch[other].middle - image_middle);
      if (distance > tolerance_m || all >= nearest) continue;
      nearest = all;
      twin[b] = other;
    }
    if (twin[b] == nobody) return {};
    twin[twin[b]] = b;
  }
  // A rig whose joints all lie in the plane shows by nothing that its sides are equal.
  for (std::uint32_t b = 0; b < count; ++b)
    if (twin[b] != b) return twin;
  return {};
}

}  // namespace

std::optional<MirrorRig> find_mirror(const SkinnedMesh& mesh, const BodyTree& tree) {
  if (mesh.bones.empty()) return std::nullopt;
  Vec3 low = joint_origin(mesh.bones[0]), high = low, sum;
  for (const Bone& bone : mesh.bones) {
    const Vec3 o = joint_origin(bone);
    low = {std::min(low.x, o.x), std::min(low.y, o.y), std::min(low.z, o.z)};
    high = {std::max(high.x, o.x), std::max(high.y, o.y), std::max(high.z, o.z)};
    sum += o;
  }
  const Vec3 mean = (1 / float(mesh.bones.size())) * sum;
  const float tolerance_m = 0.02f * length(high - low);
  for (const Vec3 normal : {Vec3{1, 0, 0}, Vec3{0, 0, 1}}) {
    std::vector<std::uint32_t> twin = twins(mesh, tree, {normal, dot(mean, normal)}, tolerance_m);
    if (!twin.empty()) return MirrorRig{normal, std::move(twin)};
  }
  return std::nullopt;
}

std::vector<JointMotion> mirrored(const MirrorRig& mirror, std::span<const JointMotion> motions) {
  std::vector<JointMotion> image(motions.size());
  for (std::size_t b = 0; b < motions.size(); ++b) {
    const JointMotion& from = motions[b];
    // A reflection turns the sense of a turn about.
    image[mirror.twin[b]] = {-reflected(from.turn, mirror.normal), reflected(from.shift, mirror.normal),
                             from.scale};
  }
  return image;
}

}  // namespace nook::bake
