#include "bakers/character/pose_variants.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "bakers/character/joined_hands.h"
#include "bakers/character/rig_anatomy.h"
#include "bakers/character/self_collision.h"
#include "bakers/raytrace/random.h"

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

// A joint and all joints below it. Two joints at the same position still differ in the joints below them.
struct Branch {
  Vec3 middle;  // mean over the joint and all joints below it, metres
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

// Pairs joints, starting at the roots. Returns an empty list if any joint has no twin.
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
  // If all joints of a rig lie in the plane, nothing shows that both sides are equal.
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
    // A reflection reverses the direction of a turn.
    image[mirror.twin[b]] = {-reflected(from.turn, mirror.normal), reflected(from.shift, mirror.normal),
                             from.scale};
  }
  return image;
}

namespace {

using Motions = std::vector<JointMotion>;

// Returns the joints that move between 2 % and 90 % of the body's area. Such parts can be exchanged between
// two poses.
std::vector<std::uint32_t> limb_roots(const SkinnedMesh& mesh, const BodyTree& tree,
                                      std::span<const float> vertex_area) {
  constexpr double least_share = 0.02, most_share = 0.9;  // share of the body's area
  std::vector<double> area(mesh.bones.size(), 0.0);
  double total = 0;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    total += double(vertex_area[i]);
    for (int s = 0; s < SkinWeights::max_bones; ++s)
      area[mesh.weights[i].bone[s]] += double(mesh.weights[i].weight[s]) * double(vertex_area[i]);
  }
  std::vector<std::uint32_t> roots;
  for (std::size_t i = tree.order.size(); i-- > 0;)
    if (tree.parent[tree.order[i]] >= 0) area[std::size_t(tree.parent[tree.order[i]])] += area[tree.order[i]];
  for (std::size_t b = 0; b < area.size(); ++b)
    if (area[b] >= least_share * total && area[b] <= most_share * total) roots.push_back(std::uint32_t(b));
  return roots;
}

// Copies the motions of a joint and of all joints below it.
void take_limb(const BodyTree& tree, std::uint32_t root, const Motions& from, Motions& to) {
  for (std::size_t b = 0; b < to.size(); ++b)
    if (b == root || is_below(tree, b, root)) to[b] = from[b];
}

class Maker {
 public:
  Maker(const SkinnedMesh& mesh, std::span<const float> vertex_area, std::span<const Pose> poses,
        const RigCorrections& corrections)
      : mesh_(mesh),
        tree_(body_tree(mesh, joint_roles(mesh, corrections))),
        mirror_(find_mirror(mesh, tree_)),
        roots_(limb_roots(mesh, tree_, vertex_area)),
        collision_(mesh, vertex_area, corrections),
        hands_(mesh, corrections) {
    for (const Pose& pose : poses) given_.push_back(joint_motions(mesh, tree_, pose));
    depth_.resize(poses.size());
    tbb::parallel_for(std::size_t(0), poses.size(),
                      [&](std::size_t i) { depth_[i] = collision_.depth(poses[i]); });
  }

  Pose make(Random& random) const {
    constexpr int tries = 8;
    // When hands are joined, the fingers keep the curl of the pose, because finger poses hardly differ
    // between the clips of a rig.
    constexpr float allowed = 0.6f, mirrored_share = 0.5f, joined_share = 0.15f;
    Pose best;
    float least = 0;
    for (int attempt = 0; attempt < tries; ++attempt) {
      float limit = allowed;
      Motions motions = draw(random, limit);
      if (mirror_ && random.chance(mirrored_share)) motions = mirrored(*mirror_, motions);
      const bool joined = hands_.possible() && random.chance(joined_share);
      if (joined) hands_.join(motions, false, random);
      Pose pose = pose_of(mesh_, tree_, motions);
      const float beyond = (joined ? collision_.depth_but_hands(pose) : collision_.depth(pose)) - limit;
      if (attempt == 0 || beyond < least) {
        least = beyond;
        best = std::move(pose);
      }
      if (least <= 0) break;
    }
    return best;
  }

 private:
  // Picks a random pose. Raises `limit` to the depth of self-intersection of this pose, because variants of a
  // pose may intersect as deeply as the pose itself.
  const Motions& pick(Random& random, float& limit) const {
    const std::size_t i = random.below(std::uint32_t(given_.size()));
    limit = std::max(limit, depth_[i]);
    return given_[i];
  }

  Motions draw(Random& random, float& limit) const {
    constexpr float blended_share = 0.4f, mixed_share = 0.6f;
    // The share of the other pose in the blend. A negative share leads away from the other pose.
    constexpr float least = -0.3f, most = 0.7f;
    constexpr int most_limbs = 3;
    Motions motions = pick(random, limit);
    if (random.chance(blended_share)) {
      const Motions& other = pick(random, limit);
      const float share = random.between(least, most);
      for (std::size_t b = 0; b < motions.size(); ++b) motions[b] = between(motions[b], other[b], share);
    }
    if (!roots_.empty() && random.chance(mixed_share)) {
      const int limbs = random.whole(1, most_limbs);
      for (int i = 0; i < limbs; ++i) {
        Motions other = pick(random, limit);
        if (mirror_ && random.chance(0.5f)) other = mirrored(*mirror_, other);
        take_limb(tree_, roots_[random.below(std::uint32_t(roots_.size()))], other, motions);
      }
    }
    return motions;
  }

  const SkinnedMesh& mesh_;
  BodyTree tree_;
  std::optional<MirrorRig> mirror_;
  std::vector<std::uint32_t> roots_;
  SelfCollision collision_;
  JoinedHands hands_;
  std::vector<Motions> given_;
  std::vector<float> depth_;
};

}  // namespace

std::vector<Pose> pose_variants(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                std::span<const Pose> poses, std::size_t count, std::uint64_t seed,
                                const RigCorrections& corrections) {
  std::vector<Pose> made;
  if (poses.empty() || count == 0) return made;
  const Maker maker(mesh, vertex_area, poses, corrections);
  made.resize(count);
  tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
    Random random(mix_bits(seed ^ mix_bits(i ^ 0x76617269616e7473ull)));
    made[i] = maker.make(random);
  });
  return made;
}

}  // namespace nook::bake
