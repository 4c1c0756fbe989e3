#include "bakers/character/auto_poses.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bakers/character/animal_poses.h"
#include "bakers/character/body_plan.h"
#include "bakers/character/hands.h"
#include "bakers/character/joined_hands.h"
#include "bakers/character/pose_sets.h"
#include "bakers/character/rig_anatomy.h"
#include "bakers/character/rotation.h"
#include "bakers/character/self_collision.h"
#include "bakers/character/torn_edges.h"

namespace nook::bake {
namespace {

// Makes poses of a rig from body plans. A joint turns about its origin, in the axes of rest space. Parents
// are turned before their children.

class PlannedRig {
 public:
  // Keeps a reference to the mesh.
  PlannedRig(const SkinnedMesh& mesh, std::vector<Joint> joints);

  // Lets a hand reach for a place on the body or for the other hand. Tries several arm poses and takes the
  // one in which the hand is nearest to the place. Hands cast and receive strong shadows only near other body
  // parts, and arms that swing at random rarely bring them there.
  void reach(BodyPlan& plan, PoseRandom& random) const;

  Pose pose(const BodyPlan& plan, PoseRandom& random) const;

  // Returns true if the rig has a clavicle that turns together with its arm when the arm swings.
  bool swings_shoulders() const {
    return std::find(carries_arm_.begin(), carries_arm_.end(), 1) != carries_arm_.end();
  }

 private:
  Vec3 in_body(Vec3 v) const { return v.x * frame_.left + v.y * frame_.up + v.z * frame_.forward; }
  Vec3 joint_turn(std::size_t bone, const BodyPlan& plan, PoseRandom& random) const;
  Vec3 arm_direction(const BodyPlan& plan, std::size_t arm) const;
  void swing_shoulders(const BodyPlan& plan, std::vector<Mat3x4>& local) const;
  void place_arms(const BodyPlan& plan, std::vector<Mat3x4>& local) const;
  void place_limbs_of_motion(const BodyPlan& plan, std::vector<Mat3x4>& local) const;

  const SkinnedMesh& mesh_;
  std::vector<Joint> joints_;
  BodyTree tree_;
  BodyFrame frame_;
  std::vector<char> posable_;
  std::vector<Vec3> curl_axis_;
  std::vector<char> laden_, parted_, carries_arm_;
  std::array<BodyPoint, 2> palm_;  // left, right
  std::size_t spine_count_ = 1, neck_count_ = 1;
};

bool is_arm(JointRole role) {
  return role == JointRole::upper_arm || role == JointRole::forearm || role == JointRole::hand ||
         role == JointRole::finger || role == JointRole::thumb;
}

Vec3 place_in(const Pose& pose, const BodyPoint& place) {
  return transform_point(pose[std::size_t(place.bone)], place.point);
}

// Returns the direction that the motion-capture pose gives to a limb's joint, in the axes of PriorLimbs.
// Returns zero if the pose has no direction for the joint.
Vec3 wished(const BodyPlan& plan, const Joint& joint) {
  const PriorLimbs& limbs = plan.motion.limbs[joint.side == Side::right ? 1 : 0];
  switch (joint.role) {
    case JointRole::upper_arm:
      return plan.arms_of_motion ? limbs.upper_arm : Vec3{};
    case JointRole::forearm:
      return plan.arms_of_motion ? limbs.forearm : Vec3{};
    case JointRole::hand:
      return plan.arms_of_motion ? limbs.hand : Vec3{};
    case JointRole::thigh:
      return plan.legs_of_motion ? limbs.thigh : Vec3{};
    case JointRole::calf:
      return plan.legs_of_motion ? limbs.calf : Vec3{};
    case JointRole::foot:
      return plan.legs_of_motion ? limbs.foot : Vec3{};
    default:
      return {};
  }
}

std::size_t count_of(std::span<const Joint> joints, JointRole role) {
  return std::size_t(
      std::count_if(joints.begin(), joints.end(), [&](const Joint& joint) { return joint.role == role; }));
}

// For each bone, returns true if the bone is a clavicle that starts near the shoulder instead of near the
// breastbone. Such a clavicle swings the arm as much as the upper arm's own joint does.
std::vector<char> shoulders_of(const SkinnedMesh& mesh, std::span<const Joint> joints, const BodyTree& tree,
                               const BodyFrame& frame) {
  // Share of the distance from the middle of the body to the upper arm. A human clavicle starts at a share of
  // 0.1 to 0.45.
  constexpr float least_share = 0.65f;
  std::vector<char> carries(joints.size(), 0);
  for (std::size_t arm = 0; arm < joints.size(); ++arm) {
    const std::int32_t clavicle = tree.parent[arm];
    if (joints[arm].role != JointRole::upper_arm || clavicle < 0 ||
        joints[std::size_t(clavicle)].role != JointRole::clavicle)
      continue;
    const float inner = dot(joint_origin(mesh.bones[std::size_t(clavicle)]), frame.left);
    const float outer = dot(joint_origin(mesh.bones[arm]), frame.left);
    carries[std::size_t(clavicle)] = inner * outer > 0 && std::fabs(inner) > least_share * std::fabs(outer);
  }
  return carries;
}

PlannedRig::PlannedRig(const SkinnedMesh& mesh, std::vector<Joint> joints)
    : mesh_(mesh),
      joints_(std::move(joints)),
      tree_(body_tree(mesh, joints_)),
      frame_(body_frame(mesh, joints_)),
      posable_(mesh.bones.size(), 0),
      curl_axis_(curl_axes(mesh, joints_, tree_, frame_.up)),
      laden_(laden_fingers(mesh, joints_, tree_)),
      parted_(parted_palms(joints_, tree_)),
      carries_arm_(shoulders_of(mesh, joints_, tree_, frame_)),
      palm_(palms(mesh, joints_, tree_)),
      spine_count_(std::max<std::size_t>(1, count_of(joints_, JointRole::spine))),
      neck_count_(
          std::max<std::size_t>(1, count_of(joints_, JointRole::neck) + count_of(joints_, JointRole::head))) {
  for (const std::uint32_t b : posable_joints(mesh)) posable_[b] = 1;
}

void PlannedRig::reach(BodyPlan& plan, PoseRandom& random) const {
  constexpr int tries = 24;
  const int side = random.chance(0.5f) ? 1 : 0;
  if (palm_[side].bone < 0) return;
  const bool other_hand = palm_[1 - side].bone >= 0 && random.chance(0.3f);
  const std::size_t vertex =
      std::min(std::size_t(random.unit() * float(mesh_.position.size())), mesh_.position.size() - 1);
  const BodyPoint target =
      other_hand ? palm_[1 - side]
                 : BodyPoint{std::int32_t(mesh_.weights[vertex].bone[0]), mesh_.position[vertex]};
  // A hand cannot reach for its own arm.
  if (joints_[std::size_t(target.bone)].side == (side ? Side::right : Side::left) &&
      is_arm(joints_[std::size_t(target.bone)].role))
    return;
  const PoseRandom noise = random;  // so that each try uses the same random numbers for the rest of the body
  float nearest = INFINITY;
  LimbPlan best = plan.limb[side];
  for (int t = 0; t < tries; ++t) {
    if (t > 0) plan_arm(plan.limb[side], random);
    PoseRandom own = noise;
    const Pose candidate = pose(plan, own);
    const float distance = length(place_in(candidate, palm_[side]) - place_in(candidate, target));
    if (distance < nearest) {
      nearest = distance;
      best = plan.limb[side];
    }
  }
  plan.limb[side] = best;
}

Pose PlannedRig::pose(const BodyPlan& plan, PoseRandom& random) const {
  std::vector<Mat3x4> local(mesh_.bones.size());
  for (std::size_t b = 0; b < local.size(); ++b) {
    const Vec3 turn = joint_turn(b, plan, random);
    local[b] = rotation_about(joint_origin(mesh_.bones[b]), turn);
  }
  swing_shoulders(plan, local);
  if (!plan.arms_of_motion) place_arms(plan, local);
  place_limbs_of_motion(plan, local);
  Pose pose(local.size());
  for (const std::uint32_t b : tree_.order) {
    const std::int32_t parent = tree_.parent[b];
    pose[b] = parent >= 0 ? pose[std::size_t(parent)] * local[b] : local[b];
  }
  return pose;
}

Vec3 PlannedRig::joint_turn(std::size_t b, const BodyPlan& plan, PoseRandom& random) const {
  const Joint& joint = joints_[b];
  const int s = joint.side == Side::right ? 1 : 0;
  const float mirror = joint.side == Side::right ? -1.0f : 1.0f;
  const LimbPlan& limb = plan.limb[s];
  const auto& [left, up, forward] = frame_;
  switch (joint.role) {
    case JointRole::spine: {
      const float share = 1 / float(spine_count_);
      if (plan.trunk_of_motion) return share * in_body(plan.motion.chest) + 0.04f * normal3(random);
      return share * (plan.bend * left + plan.lean * forward + plan.twist * up) + 0.04f * normal3(random);
    }
    case JointRole::neck:
    case JointRole::head: {
      const float share = 1 / float(neck_count_);
      if (plan.trunk_of_motion) return share * in_body(plan.motion.head);
      return share * (plan.neck.x * left + plan.neck.y * up + plan.neck.z * forward);
    }
    case JointRole::clavicle:
      return limb.clavicle;
    case JointRole::hand:
      return parted_[b] ? Vec3{} : limb.hand;
    case JointRole::finger: {
      const float curl = limb.curl + 0.2f * random.normal();
      const Vec3 spread = joint.segment == 0 ? 0.08f * random.normal() * up : Vec3{};
      return laden_[b] ? Vec3{} : finger_turn(joint, curl_axis_[b], curl) + spread;
    }
    case JointRole::thumb: {
      const Vec3 turn =
          limb.thumb * std::max(0.2f, limb.curl) * 40 * degree * curl_axis_[b] + 0.08f * normal3(random);
      return laden_[b] ? Vec3{} : turn;
    }
    case JointRole::thigh:
      // Flexion moves the knee forwards. This is a turn about -left.
      return -limb.hip_flexion * left + mirror * limb.hip_abduction * forward + mirror * limb.hip_twist * up;
    case JointRole::calf:
      return limb.knee * left;
    case JointRole::foot:
      return limb.ankle * left + 0.12f * normal3(random);
    case JointRole::toe:
      return -limb.toe * left;
    case JointRole::upper_arm:
    case JointRole::forearm:
      return {};  // place_arms sets its direction
    case JointRole::pelvis:
      return {};
    case JointRole::prop:
    case JointRole::helper:
    case JointRole::control:
      return {};
    case JointRole::leg:
    case JointRole::arm:
    case JointRole::wing:
    case JointRole::tail:
    case JointRole::jaw:
    case JointRole::ear:
    case JointRole::other: {
      if (!posable_[b] || joint.side == Side::none) return posable_[b] ? 0.06f * normal3(random) : Vec3{};
      return 0.08f * std::exp(0.5f * random.normal()) * normal3(random);
    }
  }
  return {};
}

// Points the limbs in the directions that they have in the motion-capture pose, relative to the trunk. The
// rest pose of the limbs does not matter.
void PlannedRig::place_limbs_of_motion(const BodyPlan& plan, std::vector<Mat3x4>& local) const {
  if (!plan.arms_of_motion && !plan.legs_of_motion) return;
  for (const std::uint32_t b : tree_.order) {
    const Vec3 wish = wished(plan, joints_[b]);
    if (dot(wish, wish) == 0 || parted_[b]) continue;
    Vec3 rest = limb_direction(mesh_, joints_, b);
    if (joints_[b].role == JointRole::hand && palm_[joints_[b].side == Side::right].bone == std::int32_t(b))
      rest = normalised(palm_[joints_[b].side == Side::right].point - joint_origin(mesh_.bones[b]));
    if (dot(rest, rest) == 0) continue;
    // The combined turn of the joints between the trunk and this joint.
    Mat3x4 above;
    for (std::int32_t p = tree_.parent[b]; p >= 0; p = tree_.parent[std::size_t(p)]) {
      const JointRole role = joints_[std::size_t(p)].role;
      if (role == JointRole::spine || role == JointRole::pelvis) break;
      above = local[std::size_t(p)] * above;
    }
    const Vec3 own = transform_vector(inverse_rigid(above), in_body(wish));
    local[b] = rotation_about(joint_origin(mesh_.bones[b]), shortest_arc(rest, own));
  }
}

// Returns the direction that the plan gives to an upper arm, relative to the trunk, in rest space.
Vec3 PlannedRig::arm_direction(const BodyPlan& plan, std::size_t arm) const {
  const Joint& joint = joints_[arm];
  if (plan.arms_of_motion) return in_body(wished(plan, joint));
  const float mirror = joint.side == Side::right ? -1.0f : 1.0f;
  const Vec3 direction = plan.limb[joint.side == Side::right ? 1 : 0].arm_direction;
  return normalised(in_body({mirror * direction.x, direction.y, direction.z}));
}

// When an arm swings, the clavicle that carries it turns by a part of the arm's angle.
void PlannedRig::swing_shoulders(const BodyPlan& plan, std::vector<Mat3x4>& local) const {
  for (std::size_t arm = 0; arm < joints_.size(); ++arm) {
    const std::int32_t shoulder = tree_.parent[arm];
    if (joints_[arm].role != JointRole::upper_arm || shoulder < 0 || !carries_arm_[std::size_t(shoulder)])
      continue;
    const Vec3 rest = limb_direction(mesh_, joints_, arm), wish = arm_direction(plan, arm);
    if (dot(rest, rest) == 0 || dot(wish, wish) == 0) continue;
    Mat3x4& own = local[std::size_t(shoulder)];
    const Vec3 swing = plan.shoulder_share * shortest_arc(rest, wish);
    own = rotation_about(joint_origin(mesh_.bones[std::size_t(shoulder)]), swing) * own;
  }
}

// Points upper arms and forearms in the directions of the plan. The rest pose of the arms does not matter.
void PlannedRig::place_arms(const BodyPlan& plan, std::vector<Mat3x4>& local) const {
  const auto& [left, up, forward] = frame_;
  for (std::size_t b = 0; b < joints_.size(); ++b) {
    if (joints_[b].role != JointRole::upper_arm) continue;
    const float mirror = joints_[b].side == Side::right ? -1.0f : 1.0f;
    const LimbPlan& limb = plan.limb[joints_[b].side == Side::right ? 1 : 0];
    const Vec3 rest = limb_direction(mesh_, joints_, b);
    if (dot(rest, rest) == 0) continue;
    const std::int32_t shoulder = tree_.parent[b];
    const bool carried = shoulder >= 0 && carries_arm_[std::size_t(shoulder)];
    const Mat3x4 above = carried ? local[std::size_t(shoulder)] : Mat3x4{};
    const Vec3 wish = arm_direction(plan, b);
    const Vec3 own = carried ? transform_vector(inverse_rigid(above), wish) : wish;
    const Vec3 origin = joint_origin(mesh_.bones[b]);
    local[b] = rotation_about(origin, limb.arm_twist * own) * rotation_about(origin, shortest_arc(rest, own));
    const std::int32_t elbow = joints_[b].continuation;
    if (elbow < 0) continue;
    // Relative to the posed upper arm, the forearm bends forwards, a little up and inwards. We then turn this
    // direction back into rest axes.
    const Vec3 lean = forward + 0.5f * up - 0.5f * mirror * left + limb.elbow_lean;
    const Vec3 inward = normalised(lean - dot(lean, wish) * wish);
    const Vec3 axis_posed = normalised(cross(wish, inward));
    const Vec3 axis = transform_vector(inverse_rigid(carried ? above * local[b] : local[b]), axis_posed);
    // The rest pose may already have a slight bend. So we first straighten the elbow and then bend it.
    const Vec3 fore = limb_direction(mesh_, joints_, std::size_t(elbow));
    const Vec3 joint = joint_origin(mesh_.bones[std::size_t(elbow)]);
    const Mat3x4 straighten =
        dot(fore, fore) > 0 ? rotation_about(joint, shortest_arc(fore, rest)) : Mat3x4{};
    local[std::size_t(elbow)] = rotation_about(joint, limb.elbow * axis) * straighten;
  }
}

std::vector<Pose> poses_of_person(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                  const std::vector<Joint>& joints, std::size_t count, std::uint64_t seed,
                                  const RigCorrections& corrections) {
  const PlannedRig rig(mesh, joints);
  const JoinedHands hands(mesh, corrections);
  const BodyTree tree = body_tree(mesh, joints);
  const SelfCollision collision(mesh, vertex_area, corrections);
  std::vector<Pose> poses(count);
  tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
    PoseRandom random(mix_bits(seed ^ mix_bits(i)));
    // Tries several poses. Takes the first pose without self-intersection, or else the best one. Limbs may
    // touch but must not intersect.
    constexpr int tries = 12;
    constexpr float allowed = 0.6f, reaching = 0.7f;
    // A share `of_motion` of the poses follows motion capture. Of these poses, a share `other_part` takes
    // only the arms from the plan, and another share `other_part` takes only the legs from the plan.
    constexpr float of_motion = 0.5f, other_part = 0.2f;
    // Share of all poses in which the hands are joined. Such hands may intersect each other.
    constexpr float joined_share = 0.15f;
    float best = 0;
    for (int attempt = 0; attempt < tries; ++attempt) {
      BodyPlan plan = plan_body(random);
      if (rig.swings_shoulders()) plan.shoulder_share = random.between(0.5f, 1);
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

// Returns the share of edges that a pose may tear. The most extreme poses of clips tear about twice as many
// edges as the average pose.
float allowed_tears(double torn_by_clips) {
  return std::max(0.0005f, 2 * float(torn_by_clips));
}

std::vector<Pose> poses_of_animal(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                  const std::vector<Joint>& joints, std::size_t count, std::uint64_t seed,
                                  const RigCorrections& corrections, double torn_by_clips) {
  const AnimalRig rig(mesh, joints);
  const SelfCollision collision(mesh, vertex_area, corrections);
  const std::vector<MeshEdge> edges = mesh_edges(mesh);
  std::vector<Pose> poses(count);
  tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
    PoseRandom random(mix_bits(seed ^ mix_bits(i)));
    constexpr int tries = 12;
    // The allowed depth is larger than for people, because the legs of animals are closer together and touch
    // while walking.
    constexpr float allowed = 1.0f;
    float best = 0;
    std::vector<Vec3> posed;
    for (int attempt = 0; attempt < tries; ++attempt) {
      Pose pose = rig.pose(random_act(random), random);
      skin_positions(mesh, pose, posed);
      const float torn = float(count_torn(mesh, edges, posed)) / std::max(1.0f, float(edges.size()));
      // The depth and the torn share, each divided by its limit; the larger of both. The pose is allowed if
      // this is at most 1.
      const float beyond = std::max(collision.depth(pose) / allowed, torn / allowed_tears(torn_by_clips));
      if (attempt == 0 || beyond < best) {
        best = beyond;
        poses[i] = std::move(pose);
      }
      if (best <= 1) break;
    }
  });
  return poses;
}

}  // namespace

std::vector<Pose> auto_poses(const SkinnedMesh& mesh, std::span<const float> vertex_area, std::size_t count,
                             std::uint64_t seed, const RigCorrections& corrections, double torn_by_clips) {
  const std::vector<Joint> joints = joint_roles(mesh, corrections);
  return is_person(mesh, joints)
             ? poses_of_person(mesh, vertex_area, joints, count, seed, corrections)
             : poses_of_animal(mesh, vertex_area, joints, count, seed, corrections, torn_by_clips);
}

bool differs_from_generation_4(const SkinnedMesh& mesh, const RigCorrections& corrections) {
  const std::vector<Joint> joints = joint_roles(mesh, corrections);
  const BodyTree tree = body_tree(mesh, joints);
  const std::vector<char> parted = parted_palms(joints, tree);
  return std::find(parted.begin(), parted.end(), 1) != parted.end() ||
         PlannedRig(mesh, joints).swings_shoulders();
}

}  // namespace nook::bake
