#include "bakers/character/pose_variants.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>

#include "bakers/character/joined_hands.h"
#include "bakers/character/joint_motion.h"
#include "bakers/character/mirror_rig.h"
#include "bakers/character/self_collision.h"
#include "bakers/raytrace/random.h"

namespace nook::bake {
namespace {

using Motions = std::vector<JointMotion>;

// Joints with a notable part of the body behind them: what can be exchanged between two poses.
std::vector<std::uint32_t> limb_roots(const SkinnedMesh& mesh, const BodyTree& tree,
                                      std::span<const float> vertex_area) {
  constexpr double least_share = 0.02, most_share = 0.9;  // of the body's area
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

// Copies the motions of a joint and of all below it.
void take_limb(const BodyTree& tree, std::uint32_t root, const Motions& from, Motions& to) {
  for (std::size_t b = 0; b < to.size(); ++b)
    if (b == root || is_below(tree, b, root)) to[b] = from[b];
}

class Maker {
 public:
  Maker(const SkinnedMesh& mesh, std::span<const float> vertex_area, std::span<const Pose> poses)
      : mesh_(mesh),
        tree_(body_tree(mesh)),
        mirror_(find_mirror(mesh, tree_)),
        roots_(limb_roots(mesh, tree_, vertex_area)),
        collision_(mesh, vertex_area),
        hands_(mesh) {
    for (const Pose& pose : poses) given_.push_back(joint_motions(mesh, tree_, pose));
    depth_.resize(poses.size());
    tbb::parallel_for(std::size_t(0), poses.size(),
                      [&](std::size_t i) { depth_[i] = collision_.depth(poses[i]); });
  }

  Pose make(Random& random) const {
    constexpr int tries = 8;
    // Joined hands keep the fingers of their pose, as those of one rig's clips are alike.
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
  // limit: raised to the depth of what is used, so that a pose that touches itself may go on to.
  const Motions& pick(Random& random, float& limit) const {
    const std::size_t i = random.below(std::uint32_t(given_.size()));
    limit = std::max(limit, depth_[i]);
    return given_[i];
  }

  Motions draw(Random& random, float& limit) const {
    constexpr float blended_share = 0.4f, mixed_share = 0.6f;
    // Of the way from one pose to the other; what is below 0 leads away from it.
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
                                std::span<const Pose> poses, std::size_t count, std::uint64_t seed) {
  std::vector<Pose> made;
  if (poses.empty() || count == 0) return made;
  const Maker maker(mesh, vertex_area, poses);
  made.resize(count);
  tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
    Random random(mix_bits(seed ^ mix_bits(i ^ 0x76617269616e7473ull)));
    made[i] = maker.make(random);
  });
  return made;
}

}  // namespace nook::bake
