#include "bakers/character/auto_poses.h"

#include <tbb/parallel_for.h>

#include "bakers/character/joined_hands.h"
#include "bakers/character/planned_rig.h"
#include "bakers/character/self_collision.h"

namespace nook::bake {

std::vector<Pose> auto_poses(const SkinnedMesh& mesh, std::span<const float> vertex_area, std::size_t count,
                             std::uint64_t seed) {
  const PlannedRig rig(mesh);
  const JoinedHands hands(mesh);
  const BodyTree tree = body_tree(mesh);
  const SelfCollision collision(mesh, vertex_area);
  std::vector<Pose> poses(count);
  tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
    PoseRandom random(mix_bits(seed ^ mix_bits(i)));
    // A few tries give the first that keeps out of itself, or the best: limbs may touch, and must not
    // intersect.
    constexpr int tries = 12;
    constexpr float allowed = 0.6f, reaching = 0.7f;
    // Half of the poses follow motion capture; of these, a share has other arms, and a share other legs.
    constexpr float of_motion = 0.5f, other_part = 0.2f;
    // Of all poses; hands that hold each other may run into each other.
    constexpr float joined_share = 0.15f;
    float best = 0;
    for (int attempt = 0; attempt < tries; ++attempt) {
      BodyPlan plan = plan_body(random);
      if (random.chance(of_motion)) {
        Random motion(random.bits());
        plan.motion = prior_pose(motion);
        const float keep = random.unit();
        plan.trunk_of_motion = true;
        plan.arms_of_motion = keep > other_part;
        plan.legs_of_motion = keep < 1 - other_part;
      }
      if (!plan.arms_of_motion && random.chance(reaching)) rig.reach(plan, random);
      Pose pose = rig.pose(plan, random);
      const bool joined = hands.possible() && random.chance(joined_share);
      if (joined) {
        std::vector<JointMotion> motions = joint_motions(mesh, tree, pose);
        Random grip(random.bits());
        hands.join(motions, true, grip);
        pose = pose_of(mesh, tree, motions);
      }
      const float depth = joined ? collision.depth_but_hands(pose) : collision.depth(pose);
      if (attempt == 0 || depth < best) {
        best = depth;
        poses[i] = std::move(pose);
      }
      if (best <= allowed) break;
    }
  });
  return poses;
}

}  // namespace nook::bake
