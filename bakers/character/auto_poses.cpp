#include "bakers/character/auto_poses.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "bakers/character/body_tree.h"
#include "bakers/character/initialise.h"
#include "bakers/character/joint_roles.h"
#include "bakers/character/pose_prior.h"
#include "bakers/character/pose_sets.h"
#include "bakers/character/rotation.h"
#include "bakers/character/self_collision.h"
#include "bakers/raytrace/random.h"

namespace nook::bake {
namespace {

constexpr float degree = std::numbers::pi_v<float> / 180;

using PoseRandom = RandomFrom<std::mt19937_64>;

Vec3 normal3(PoseRandom& random) {
  const float x = random.normal(), y = random.normal(), z = random.normal();
  return {x, y, z};
}

// Directions of the body in rest space.
struct BodyFrame {
  Vec3 left, up, forward;
};

Vec3 joint_origin(const Bone& bone) {
  return {bone.frame_rest.m[3], bone.frame_rest.m[7], bone.frame_rest.m[11]};
}

BodyFrame body_frame(const SkinnedMesh& mesh, std::span<const Joint> joints) {
  Vec3 sum;
  for (std::size_t b = 0; b < joints.size(); ++b) {
    if (joints[b].role == JointRole::other) continue;
    if (joints[b].side == Side::left) sum += joint_origin(mesh.bones[b]);
    if (joints[b].side == Side::right) sum += -1.0f * joint_origin(mesh.bones[b]);
  }
  BodyFrame frame;
  frame.up = {0, 1, 0};
  frame.left = normalised({sum.x, 0, sum.z});
  if (dot(frame.left, frame.left) == 0) frame.left = {1, 0, 0};
  frame.forward = cross(frame.left, frame.up);
  return frame;
}

// The motion of the limbs of one side in one pose; angles in radians.
struct LimbPlan {
  Vec3 arm_direction;  // of the upper arm, body frame axes (left, up, forward), mirrored for the right side
  float arm_twist, elbow, hip_flexion, hip_abduction, hip_twist, knee, ankle, toe, curl, thumb;
  Vec3 elbow_lean;  // random part of the direction to which the elbow bends
  Vec3 clavicle, hand;
};

void plan_arm(LimbPlan& plan, PoseRandom& random) {
  // Arms: hanging, reaching forwards, raised to the side or overhead. Elevation from straight down, azimuth
  // from the front.
  const float kind = random.unit();
  float elevation, azimuth;
  if (kind < 0.45f) {
    elevation = std::fabs(12 + 18 * random.normal()) * degree;
    azimuth = random.between(-60, 150) * degree;
    plan.elbow =
        std::fabs(random.chance(0.5f) ? 15 + 15 * random.normal() : 60 + 40 * random.normal()) * degree;
  } else if (kind < 0.85f) {
    elevation = (60 + 25 * random.normal()) * degree;
    azimuth = (15 + 35 * random.normal()) * degree;
    plan.elbow = std::fabs(60 + 45 * random.normal()) * degree;
  } else {
    elevation = random.between(60, 165) * degree;
    azimuth = random.between(10, 110) * degree;
    plan.elbow = std::fabs(45 + 45 * random.normal()) * degree;
  }
  plan.elbow = std::min(plan.elbow, 145 * degree);
  plan.arm_direction = {std::sin(elevation) * std::sin(azimuth), -std::cos(elevation),
                        std::sin(elevation) * std::cos(azimuth)};
  plan.arm_twist = 25 * degree * random.normal();
  plan.elbow_lean = 0.5f * normal3(random);
}

LimbPlan plan_limbs(PoseRandom& random) {
  LimbPlan plan;
  plan_arm(plan, random);
  // Legs: standing, striding, crouching or sitting, kicked back.
  const float stance = random.unit();
  if (stance < 0.35f) {
    plan.hip_flexion = 10 * degree * random.normal();
    plan.knee = std::fabs(10 * random.normal()) * degree;
  } else if (stance < 0.65f) {
    plan.hip_flexion = (10 + 28 * random.normal()) * degree;
    plan.knee = std::fabs(30 + 28 * random.normal()) * degree;
  } else if (stance < 0.95f) {
    plan.hip_flexion = (80 + 22 * random.normal()) * degree;
    plan.knee = std::fabs(90 + 28 * random.normal()) * degree;
  } else {
    plan.hip_flexion = random.between(-40, 0) * degree;
    plan.knee = random.between(20, 120) * degree;
  }
  plan.hip_flexion = std::clamp(plan.hip_flexion, -45 * degree, 130 * degree);
  plan.knee = std::clamp(plan.knee, 0.0f, 145 * degree);
  plan.hip_abduction = (6 + 12 * random.normal()) * degree;
  plan.hip_twist = 12 * degree * random.normal();
  plan.ankle = 15 * degree * random.normal();
  plan.toe = random.chance(0.3f) ? random.between(0, 40) * degree : 0;
  // Fingers: open, relaxed or a fist.
  const float grip = random.unit();
  plan.curl = grip < 0.25f   ? 0.08f * random.normal()
              : grip < 0.65f ? 0.35f + 0.15f * random.normal()
                             : 0.85f + 0.15f * random.normal();
  plan.thumb = random.unit();
  plan.clavicle = (12 * degree) * normal3(random);
  plan.hand = (30 * degree) * normal3(random);
  return plan;
}

struct BodyPlan {
  LimbPlan limb[2];         // left, right
  float bend, lean, twist;  // of the whole spine, radians
  Vec3 neck;
  // A pose of motion capture, and the parts of the body that take it in place of the plan above.
  PriorPose motion;
  bool trunk_of_motion = false, arms_of_motion = false, legs_of_motion = false;
};

BodyPlan plan_body(PoseRandom& random) {
  BodyPlan plan;
  plan.limb[0] = plan_limbs(random);
  plan.limb[1] = plan_limbs(random);
  // People often do the same with both sides; then the sides differ a little.
  if (random.chance(0.4f)) {
    LimbPlan& l = plan.limb[1];
    l = plan.limb[0];
    l.arm_direction = normalised(l.arm_direction + 0.15f * normal3(random));
    l.elbow = std::fabs(l.elbow + 10 * degree * random.normal());
    l.hip_flexion += 8 * degree * random.normal();
    l.knee = std::fabs(l.knee + 8 * degree * random.normal());
    l.curl += 0.1f * random.normal();
  } else if (random.chance(0.4f)) {
    plan.limb[1].hip_flexion = plan.limb[0].hip_flexion + 10 * degree * random.normal();
    plan.limb[1].knee = std::fabs(plan.limb[0].knee + 10 * degree * random.normal());
  }
  // Both hands before the body, as for holding, aiming, praying or resting in the lap.
  if (random.chance(0.15f)) {
    LimbPlan& l = plan.limb[0];
    const float elevation = random.between(5, 115) * degree;
    const float azimuth = (-15 + 20 * random.normal()) * degree;
    l.arm_direction = {std::sin(elevation) * std::sin(azimuth), -std::cos(elevation),
                       std::sin(elevation) * std::cos(azimuth)};
    l.elbow = random.between(5, 110) * degree;
    l.elbow_lean = Vec3{-0.5f, 0, 0} + 0.3f * normal3(random);
    LimbPlan& r = plan.limb[1];
    r.arm_direction = normalised(l.arm_direction + 0.15f * normal3(random));
    r.elbow = std::fabs(l.elbow + 20 * degree * random.normal());
    r.elbow_lean = {l.elbow_lean.x, l.elbow_lean.y, l.elbow_lean.z};
  }
  const float crouch = std::max(0.0f, std::min(plan.limb[0].hip_flexion, plan.limb[1].hip_flexion));
  plan.bend = (8 + 22 * random.normal()) * degree + 0.25f * crouch * random.unit();
  // A spine bends backwards by about 30 degrees and forwards by three times as much.
  plan.bend = std::clamp(plan.bend, -30 * degree, 90 * degree);
  plan.lean = 12 * degree * random.normal();
  plan.twist = 20 * degree * random.normal();
  plan.neck = {28 * degree * random.normal(), 32 * degree * random.normal(), 14 * degree * random.normal()};
  // A head over a bent trunk is raised to look ahead.
  plan.neck.x -= 0.7f * std::max(0.0f, plan.bend) * random.unit();
  return plan;
}

// The rotation that takes one unit vector to another by the shortest way.
Vec3 shortest_arc(Vec3 from, Vec3 to) {
  const Vec3 axis = cross(from, to);
  const float s = length(axis), c = dot(from, to);
  if (s < 1e-6f) {
    if (c > 0) return {};
    const Vec3 any = std::fabs(from.x) < 0.7f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    return std::numbers::pi_v<float> * normalised(cross(from, any));
  }
  return std::atan2(s, c) / s * axis;
}

// Turns of a rig's joints by a plan, in rest-space axes round each joint's origin, parents first.
class Rig {
 public:
  explicit Rig(const SkinnedMesh& mesh)
      : mesh_(mesh),
        joints_(joint_roles(mesh)),
        tree_(body_tree(mesh, joints_)),
        frame_(body_frame(mesh, joints_)) {
    posable_.assign(mesh.bones.size(), 0);
    for (std::uint32_t b : posable_joints(mesh)) posable_[b] = 1;
    spine_count_ = std::max<std::size_t>(
        1, std::size_t(std::count_if(joints_.begin(), joints_.end(),
                                     [](const Joint& j) { return j.role == JointRole::spine; })));
    neck_count_ = std::max<std::size_t>(
        1, std::size_t(std::count_if(joints_.begin(), joints_.end(), [](const Joint& j) {
          return j.role == JointRole::neck || j.role == JointRole::head;
        })));
    find_curl_axes();
    find_palms();
  }

  // Lets a hand reach for a place on the body or for the other hand: what hands come near is what shadows of
  // hands and on hands depend on, and arms that swing freely are seldom there. Of some arms the one that
  // comes nearest is taken.
  void reach(BodyPlan& plan, PoseRandom& random, std::span<const Vec3> vertices) const {
    constexpr int tries = 24;
    const int side = random.chance(0.5f) ? 1 : 0;
    if (palm_[side].bone < 0) return;
    const bool other_hand = palm_[1 - side].bone >= 0 && random.chance(0.3f);
    const std::size_t vertex =
        std::min(std::size_t(random.unit() * float(vertices.size())), vertices.size() - 1);
    const Place target =
        other_hand ? palm_[1 - side] : Place{std::int32_t(mesh_.weights[vertex].bone[0]), vertices[vertex]};
    // A hand cannot reach for its own arm.
    if (joints_[std::size_t(target.bone)].side == palm_side(side) &&
        is_arm(joints_[std::size_t(target.bone)].role))
      return;
    const PoseRandom noise = random;  // what a pose draws must not differ between the tries
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

  Pose pose(const BodyPlan& plan, PoseRandom& random) const {
    std::vector<Mat3x4> local(mesh_.bones.size());
    for (std::size_t b = 0; b < local.size(); ++b) {
      const Vec3 turn = joint_turn(b, plan, random);
      local[b] = rotation_about(joint_origin(mesh_.bones[b]), turn);
    }
    if (!plan.arms_of_motion) place_arms(plan, local);
    place_limbs_of_motion(plan, local);
    Pose pose(local.size());
    for (const std::uint32_t b : tree_.order) {
      const std::int32_t parent = tree_.parent[b];
      pose[b] = parent >= 0 ? pose[std::size_t(parent)] * local[b] : local[b];
    }
    return pose;
  }

 private:
  // A point of the body, rest space; bone -1: there is none.
  struct Place {
    std::int32_t bone = -1;
    Vec3 point;
  };
  static Vec3 place_in(const Pose& pose, const Place& place) {
    return transform_point(pose[std::size_t(place.bone)], place.point);
  }
  static Side palm_side(int side) { return side ? Side::right : Side::left; }
  static bool is_arm(JointRole role) {
    return role == JointRole::upper_arm || role == JointRole::forearm || role == JointRole::hand ||
           role == JointRole::finger || role == JointRole::thumb;
  }

  // The middle of the knuckles, or the wrist where there are none.
  void find_palms() {
    for (std::size_t hand = 0; hand < joints_.size(); ++hand) {
      if (joints_[hand].role != JointRole::hand || joints_[hand].side == Side::none) continue;
      Vec3 sum = joint_origin(mesh_.bones[hand]);
      float count = 1;
      for (std::size_t b = 0; b < joints_.size(); ++b) {
        if (joints_[b].role != JointRole::finger || joints_[b].segment != 0 || !is_below(tree_, b, hand))
          continue;
        if (count++ == 1) sum = {};
        sum += joint_origin(mesh_.bones[b]);
      }
      palm_[joints_[hand].side == Side::right] = {std::int32_t(hand), sum * (1 / std::max(1.0f, count - 1))};
    }
  }

  Vec3 direction_of(std::size_t bone) const {
    const std::int32_t next = joints_[bone].continuation;
    return next < 0
               ? Vec3{}
               : normalised(joint_origin(mesh_.bones[std::size_t(next)]) - joint_origin(mesh_.bones[bone]));
  }

  // Fingers curl towards the palm: about the axis across them, on the side that the thumb is on.
  void find_curl_axes() {
    curl_axis_.assign(mesh_.bones.size(), Vec3{});
    for (std::size_t hand = 0; hand < joints_.size(); ++hand) {
      if (joints_[hand].role != JointRole::hand) continue;
      const Vec3 wrist = joint_origin(mesh_.bones[hand]);
      Vec3 along, thumb;
      std::vector<std::size_t> knuckles, members;
      for (std::size_t b = 0; b < joints_.size(); ++b) {
        if (!is_below(tree_, b, hand)) continue;
        if (joints_[b].role == JointRole::finger) {
          members.push_back(b);
          if (joints_[b].segment == 0) {
            knuckles.push_back(b);
            along += normalised(joint_origin(mesh_.bones[b]) - wrist);
          }
        } else if (joints_[b].role == JointRole::thumb) {
          members.push_back(b);
          thumb += joint_origin(mesh_.bones[b]) - wrist;
        }
      }
      if (knuckles.empty()) continue;
      along = normalised(along);
      // The knuckle farthest from the others on the thumb's side is the index finger.
      Vec3 across;
      for (std::size_t a : knuckles)
        for (std::size_t b : knuckles) {
          const Vec3 d = joint_origin(mesh_.bones[a]) - joint_origin(mesh_.bones[b]);
          if (length(d) > length(across)) across = d;
        }
      if (length(across) == 0) across = cross(along, frame_.up);
      if (dot(across, thumb) < 0) across = -across;
      across = normalised(across - dot(across, along) * along);
      // Rest curl, where there is any, is the surest sign; else the palm is where the thumb hangs.
      Vec3 bend;
      for (std::size_t b : members) {
        const std::int32_t next = joints_[b].continuation, parent = tree_.parent[b];
        if (joints_[b].role != JointRole::finger || next < 0 || joints_[b].segment == 0 || parent < 0)
          continue;
        bend += cross(direction_of(std::size_t(parent)), direction_of(b));
      }
      Vec3 axis = across;
      if (length(bend) > 0.05f * float(knuckles.size())) {
        if (dot(bend, across) < 0) axis = -across;
      } else if (dot(cross(across, along), thumb) < 0) {
        axis = -across;
      }
      for (std::size_t b : members) {
        if (joints_[b].role == JointRole::finger) {
          curl_axis_[b] = axis;
        } else {
          // The thumb folds over the palm: half about its own length seen from the palm.
          const Vec3 palm = cross(axis, along);
          const Vec3 own = normalised(thumb);
          const Vec3 fold = cross(own, normalised(palm - across));
          curl_axis_[b] = normalised(dot(fold, fold) > 0 ? fold : axis);
        }
      }
    }
  }

  Vec3 in_body(Vec3 v) const { return v.x * frame_.left + v.y * frame_.up + v.z * frame_.forward; }

  Vec3 joint_turn(std::size_t b, const BodyPlan& plan, PoseRandom& random) const {
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
        return limb.hand;
      case JointRole::finger: {
        static constexpr float reach[3] = {85, 100, 70};
        const float curl = std::clamp(limb.curl + 0.2f * random.normal(), -0.1f, 1.1f);
        const Vec3 spread = joint.segment == 0 ? 0.08f * random.normal() * up : Vec3{};
        return curl * reach[std::min<int>(joint.segment, 2)] * degree * curl_axis_[b] + spread;
      }
      case JointRole::thumb:
        return limb.thumb * std::max(0.2f, limb.curl) * 40 * degree * curl_axis_[b] + 0.08f * normal3(random);
      case JointRole::thigh:
        // Flexion swings the knee forwards: a turn about -left.
        return -limb.hip_flexion * left + mirror * limb.hip_abduction * forward +
               mirror * limb.hip_twist * up;
      case JointRole::calf:
        return limb.knee * left;
      case JointRole::foot:
        return limb.ankle * left + 0.12f * normal3(random);
      case JointRole::toe:
        return -limb.toe * left;
      case JointRole::upper_arm:
      case JointRole::forearm:
        return {};  // placed by direction, see place_arms
      case JointRole::pelvis:
        return {};
      case JointRole::other: {
        if (!posable_[b] || joint.side == Side::none) return posable_[b] ? 0.06f * normal3(random) : Vec3{};
        return 0.08f * std::exp(0.5f * random.normal()) * normal3(random);
      }
    }
    return {};
  }

  // The direction in which motion capture holds a limb's joint, in its part's axes; zero where it has none.
  static Vec3 wished(const BodyPlan& plan, const Joint& joint) {
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

  // Limbs go where motion capture points, seen from the trunk, whatever pose they rest in.
  void place_limbs_of_motion(const BodyPlan& plan, std::vector<Mat3x4>& local) const {
    if (!plan.arms_of_motion && !plan.legs_of_motion) return;
    for (const std::uint32_t b : tree_.order) {
      const Vec3 wish = wished(plan, joints_[b]);
      if (dot(wish, wish) == 0) continue;
      Vec3 rest = direction_of(b);
      if (joints_[b].role == JointRole::hand && palm_[joints_[b].side == Side::right].bone == std::int32_t(b))
        rest = normalised(palm_[joints_[b].side == Side::right].point - joint_origin(mesh_.bones[b]));
      if (dot(rest, rest) == 0) continue;
      // The turn of the joints between the trunk and this one.
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

  // Upper arms and forearms go where the plan points, whatever pose they rest in.
  void place_arms(const BodyPlan& plan, std::vector<Mat3x4>& local) const {
    const auto& [left, up, forward] = frame_;
    for (std::size_t b = 0; b < joints_.size(); ++b) {
      if (joints_[b].role != JointRole::upper_arm) continue;
      const float mirror = joints_[b].side == Side::right ? -1.0f : 1.0f;
      const LimbPlan& limb = plan.limb[joints_[b].side == Side::right ? 1 : 0];
      const Vec3 rest = direction_of(b);
      if (dot(rest, rest) == 0) continue;
      const Vec3 wish = normalised(mirror * limb.arm_direction.x * left + limb.arm_direction.y * up +
                                   limb.arm_direction.z * forward);
      const Vec3 origin = joint_origin(mesh_.bones[b]);
      local[b] =
          rotation_about(origin, limb.arm_twist * wish) * rotation_about(origin, shortest_arc(rest, wish));
      const std::int32_t elbow = joints_[b].continuation;
      if (elbow < 0) continue;
      // The forearm bends forwards, a little up and inwards, seen from the posed upper arm, then back into
      // rest axes.
      const Vec3 lean = forward + 0.5f * up - 0.5f * mirror * left + limb.elbow_lean;
      const Vec3 inward = normalised(lean - dot(lean, wish) * wish);
      const Vec3 axis_posed = normalised(cross(wish, inward));
      const Vec3 axis = transform_vector(inverse_rigid(local[b]), axis_posed);
      // The rest pose may hold a slight bend already: first straighten, then bend.
      const Vec3 fore = direction_of(std::size_t(elbow));
      const Vec3 joint = joint_origin(mesh_.bones[std::size_t(elbow)]);
      const Mat3x4 straighten =
          dot(fore, fore) > 0 ? rotation_about(joint, shortest_arc(fore, rest)) : Mat3x4{};
      local[std::size_t(elbow)] = rotation_about(joint, limb.elbow * axis) * straighten;
    }
  }

  const SkinnedMesh& mesh_;
  std::vector<Joint> joints_;
  BodyTree tree_;
  BodyFrame frame_;
  std::vector<char> posable_;
  std::vector<Vec3> curl_axis_;
  Place palm_[2];  // left, right
  std::size_t spine_count_ = 1, neck_count_ = 1;
};

}  // namespace

std::vector<Pose> auto_poses(const SkinnedMesh& mesh, std::span<const float> vertex_area, std::size_t count,
                             std::uint64_t seed) {
  const Rig rig(mesh);
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
      if (!plan.arms_of_motion && random.chance(reaching)) rig.reach(plan, random, mesh.position);
      Pose pose = rig.pose(plan, random);
      const float depth = collision.depth(pose);
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
