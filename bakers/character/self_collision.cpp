#include "bakers/character/self_collision.h"

#include <algorithm>

namespace nook::bake {
namespace {

// Bones that are this near in the hierarchy share flesh, so their spheres always overlap.
constexpr int related_hops = 2;

bool related(const BodyTree& tree, std::size_t a, std::size_t b) {
  const auto ancestors = [&](std::size_t bone) {
    std::vector<std::size_t> up{bone};
    for (int i = 0; i < related_hops && tree.parent[up.back()] >= 0; ++i)
      up.push_back(std::size_t(tree.parent[up.back()]));
    return up;
  };
  const std::vector<std::size_t> up_a = ancestors(a), up_b = ancestors(b);
  for (std::size_t i = 0; i < up_a.size(); ++i)
    for (std::size_t j = 0; j < up_b.size(); ++j)
      if (up_a[i] == up_b[j] && i + j <= std::size_t(related_hops)) return true;
  return false;
}

// For each bone, returns the hand that it belongs to, or -1. A hand has the index of the forearm that it
// hangs on.
std::vector<std::int32_t> hands_of_bones(const BodyTree& tree, std::span<const Joint> joints) {
  std::vector<std::int32_t> hand(joints.size(), -1);
  for (const std::uint32_t b : tree.order) {
    const std::int32_t parent = tree.parent[b];
    if (parent < 0) continue;
    const bool arm_ends = joints[std::size_t(parent)].role == JointRole::forearm;
    hand[b] = arm_ends && joints[b].role == JointRole::hand ? parent : hand[std::size_t(parent)];
  }
  return hand;
}

float overlap(Vec3 a, float radius_a, Vec3 b, float radius_b) {
  return radius_a + radius_b - length(a - b);
}

}  // namespace

SelfCollision::SelfCollision(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                             const RigCorrections& corrections)
    : spheres_(initial_spheres(mesh, vertex_area, 100)) {
  // The radius of an initial sphere is a standard deviation. For vertices on a round limb, it is the limb's
  // radius divided by sqrt(2).
  for (InitialSphere& s : spheres_) s.radius *= 1.414f;
  const std::vector<Joint> joints = joint_roles(mesh, corrections);
  const BodyTree tree = body_tree(mesh, joints);
  const std::vector<std::int32_t> hand = hands_of_bones(tree, joints);
  for (std::size_t i = 0; i < spheres_.size(); ++i)
    for (std::size_t j = i + 1; j < spheres_.size(); ++j) {
      // Skip pairs within one hand, because fingers touch each other and the palm in every fist.
      if (hand[spheres_[i].bone] >= 0 && hand[spheres_[i].bone] == hand[spheres_[j].bone]) continue;
      if (related(tree, spheres_[i].bone, spheres_[j].bone)) continue;
      pairs_.push_back({std::uint16_t(i), std::uint16_t(j)});
      is_of_hands_.push_back(hand[spheres_[i].bone] >= 0 && hand[spheres_[j].bone] >= 0);
      rest_overlap_.push_back(std::max(
          0.0f, overlap(spheres_[i].centre, spheres_[i].radius, spheres_[j].centre, spheres_[j].radius)));
    }
}

float SelfCollision::depth(const Pose& pose) const {
  return deepest(pose, true);
}

float SelfCollision::depth_but_hands(const Pose& pose) const {
  return deepest(pose, false);
}

float SelfCollision::deepest(const Pose& pose, bool with_hands) const {
  std::vector<Vec3> centre(spheres_.size());
  for (std::size_t i = 0; i < centre.size(); ++i)
    centre[i] = transform_point(pose[spheres_[i].bone], spheres_[i].centre);
  float deepest = 0;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    if (!with_hands && is_of_hands_[p]) continue;
    const auto [i, j] = pairs_[p];
    const float radius_i = spheres_[i].radius, radius_j = spheres_[j].radius;
    const float more = overlap(centre[i], radius_i, centre[j], radius_j) - rest_overlap_[p];
    deepest = std::max(deepest, more / std::min(radius_i, radius_j));
  }
  return deepest;
}

}  // namespace nook::bake
