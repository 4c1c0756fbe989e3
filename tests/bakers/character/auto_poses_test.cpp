// The poses that a bake makes without clips: what they reach, and that they hang together.
#include "bakers/character/auto_poses.h"

#include <algorithm>
#include <cmath>

#include "bakers/character/body_plan.h"
#include "bakers/character/hands.h"
#include "bakers/character/joined_hands.h"
#include "bakers/character/rig_anatomy.h"
#include "bakers/character/self_collision.h"
#include "bakers/import/skinned_mesh.h"
#include "tests/bakers/character/stick_figure.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

std::size_t bone_named(const SkinnedMesh& mesh, const char* name) {
  for (std::size_t b = 0; b < mesh.bones.size(); ++b)
    if (mesh.bones[b].name == name) return b;
  FAIL("no bone " << name);
  return 0;
}

Vec3 origin(const SkinnedMesh& mesh, std::size_t bone) {
  const Mat3x4& f = mesh.bones[bone].frame_rest;
  return {f.m[3], f.m[7], f.m[11]};
}

std::vector<Pose> poses_of(const SkinnedMesh& mesh, std::size_t count) {
  return auto_poses(mesh, vertex_areas(mesh, mesh.position), count, 3);
}

template <class Predicate>
double share_of(const std::vector<Pose>& poses, Predicate predicate) {
  return double(std::count_if(poses.begin(), poses.end(), predicate)) / double(poses.size());
}

// Four fingers and a thumb of one joint each on both hands; palms face down.
SkinnedMesh figure_with_fingers() {
  SkinnedMesh mesh = stick_figure();
  for (const float side : {1.0f, -1.0f}) {
    const std::string end = side > 0 ? "_l" : "_r";
    const auto hand = std::int32_t(bone_named(mesh, ("hand" + end).c_str()));
    const auto add = [&](const char* name, Vec3 origin) {
      Bone b;
      b.name = name + end;
      b.parent = hand;
      b.frame_rest.m[3] = side * origin.x;
      b.frame_rest.m[7] = origin.y;
      b.frame_rest.m[11] = origin.z;
      mesh.bones.push_back(b);
    };
    add("index_01", {0.80f, 1.4f, 0.03f});
    add("middle_01", {0.81f, 1.4f, 0.01f});
    add("ring_01", {0.80f, 1.4f, -0.01f});
    add("pinky_01", {0.79f, 1.4f, -0.03f});
    add("thumb_01", {0.74f, 1.38f, 0.04f});
  }
  return mesh;
}

}  // namespace

TEST_CASE("loose feet hang on the calves, and stay there in automatic poses") {
  for (const bool loose : {false, true}) {
    const SkinnedMesh mesh = stick_figure(loose);
    const BodyTree tree = body_tree(mesh);
    for (const char* side : {"_l", "_r"}) {
      const std::size_t calf = bone_named(mesh, (std::string("calf") + side).c_str());
      const std::size_t foot = bone_named(mesh, (std::string("foot") + side).c_str());
      CHECK(tree.parent[foot] == std::int32_t(calf));
      for (const Pose& pose : poses_of(mesh, 50)) {
        const Vec3 ankle = origin(mesh, foot);
        // Single precision over a chain of four joints of a body of 2 m.
        CHECK(length(transform_point(pose[foot], ankle) - transform_point(pose[calf], ankle)) < 1e-4f);
      }
    }
    std::vector<char> seen(tree.parent.size(), 0);
    for (const std::uint32_t b : tree.order) {
      CHECK((tree.parent[b] < 0 || seen[std::size_t(tree.parent[b])]));
      seen[b] = 1;
    }
    CHECK(tree.order.size() == mesh.bones.size());
  }
}

TEST_CASE("heads are raised and lowered, arms raised, trunks bent, knees bent") {
  const SkinnedMesh mesh = stick_figure();
  const std::vector<Pose> poses = poses_of(mesh, 600);
  const std::size_t chest = bone_named(mesh, "spine_02"), head = bone_named(mesh, "head"),
                    arm = bone_named(mesh, "upperarm_l"), calf = bone_named(mesh, "calf_l"),
                    thigh = bone_named(mesh, "thigh_l");
  // The angle by which the face looks up, seen from the chest.
  const auto raised = [&](const Pose& p) {
    const Vec3 face = transform_vector(p[head], {0, 0, 1}), up = transform_vector(p[chest], {0, 1, 0});
    return std::asin(std::clamp(dot(face, up), -1.0f, 1.0f));
  };
  // Clips raise heads by 18 to 60 degrees and lower them as far; less than a tenth of poses would leave them
  // unlearned, and beyond 85 degrees no neck goes but in rare draws.
  CHECK(share_of(poses, [&](const Pose& p) { return raised(p) > 18 * degree; }) > 0.1);
  CHECK(share_of(poses, [&](const Pose& p) { return raised(p) < -18 * degree; }) > 0.1);
  CHECK(share_of(poses, [&](const Pose& p) { return std::fabs(raised(p)) > 85 * degree; }) < 0.02);
  const auto along_arm = [&](const Pose& p) {
    return dot(transform_vector(p[arm], {1, 0, 0}), transform_vector(p[chest], {0, 1, 0}));
  };
  CHECK(share_of(poses, [&](const Pose& p) { return along_arm(p) > 0.3f; }) > 0.05);  // overhead
  CHECK(share_of(poses, [&](const Pose& p) { return along_arm(p) < -0.8f; }) > 0.1);  // hanging
  // The trunk leans back less often than it bends; a knee never bends forwards by more than a jitter.
  const auto bend = [&](const Pose& p) { return transform_vector(p[chest], {0, 1, 0}).z; };
  CHECK(share_of(poses, [&](const Pose& p) { return bend(p) > 0.3f; }) > 0.15);
  CHECK(share_of(poses, [&](const Pose& p) { return bend(p) < -0.5f; }) < 0.1);
  const auto forward_shin = [&](const Pose& p) {
    return dot(transform_vector(p[calf], {0, -1, 0}), transform_vector(p[thigh], {0, 0, 1}));
  };
  CHECK(share_of(poses, [&](const Pose& p) { return forward_shin(p) > 0.35f; }) < 0.02);
}

TEST_CASE("most automatic poses keep out of themselves") {
  const SkinnedMesh mesh = stick_figure();
  const SelfCollision collision(mesh, vertex_areas(mesh, mesh.position));
  // The limit is 0.6 of a sphere's radius; a pose beyond it is the best of twelve tries.
  CHECK(share_of(poses_of(mesh, 300), [&](const Pose& p) { return collision.depth(p) <= 0.6f; }) > 0.95);
}

TEST_CASE("what is in one hand does not collide, two hands do") {
  SkinnedMesh mesh = stick_figure();
  const std::size_t left = bone_named(mesh, "hand_l"), right = bone_named(mesh, "hand_r");
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  const SelfCollision collision(mesh, area);
  Pose pose(mesh.bones.size());
  const Vec3 across = origin(mesh, right) - origin(mesh, left);
  pose[left].m[3] += across.x - 0.17f;  // onto the other hand, mirrored
  CHECK(collision.depth(pose) > 0.6f);
  // A metre before the body they touch nothing but each other.
  pose[left].m[11] += 1;
  pose[right].m[11] += 1;
  CHECK(collision.depth(pose) > 0.6f);
  CHECK(collision.depth_but_hands(pose) == 0);
}

TEST_CASE("joined hands meet before the trunk with palms to each other, and all else stays") {
  const SkinnedMesh mesh = figure_with_fingers();
  const BodyTree tree = body_tree(mesh);
  const JoinedHands hands(mesh);
  REQUIRE(hands.possible());
  CHECK_FALSE(JoinedHands(stick_figure()).possible());  // it has no fingers
  const std::size_t left = bone_named(mesh, "hand_l"), right = bone_named(mesh, "hand_r"),
                    fore = bone_named(mesh, "lowerarm_l"), thigh = bone_named(mesh, "thigh_l");
  const float hand = length(Vec3{0.80f, 1.4f, 0} - origin(mesh, left));
  const Mat3x4 rest;
  constexpr int count = 200;
  int near = 0, before = 0, facing = 0;
  for (int i = 0; i < count; ++i) {
    std::vector<JointMotion> motions(mesh.bones.size());
    Random random{std::uint64_t(i)}, again{std::uint64_t(i)};
    hands.join(motions, true, random);
    std::vector<JointMotion> same(mesh.bones.size());
    hands.join(same, true, again);
    CHECK(same[left].turn == motions[left].turn);
    const Pose pose = pose_of(mesh, tree, motions);
    const Vec3 l = transform_point(pose[left], {0.80f, 1.4f, 0}),
               r = transform_point(pose[right], {-0.80f, 1.4f, 0});
    near += length(l - r) < 2.5f * hand;
    before += 0.5f * (l + r).z > 0;
    facing += dot(transform_vector(pose[left], {0, -1, 0}), transform_vector(pose[right], {0, -1, 0})) < 0.5f;
    // Single precision over a chain of six joints of a body of 2 m.
    CHECK(length(transform_point(pose[left], origin(mesh, left)) -
                 transform_point(pose[fore], origin(mesh, left))) < 1e-4f);
    CHECK(std::equal(std::begin(pose[thigh].m), std::end(pose[thigh].m), std::begin(rest.m)));
  }
  // The knuckles of stacked fists are 1.4 hands apart along the handle and up to 1.2 across it, each missed
  // by a quarter of a hand; a place out of reach of twelve draws is rare.
  CHECK(near > 0.9 * count);
  CHECK(before > 0.95 * count);
  // Fingers of both hands point forwards, so that palms face each other unless one hand is reversed.
  CHECK(facing > 0.75 * count);
}

TEST_CASE("poses of motion capture have limbs of unit length, two equal sides, and are the same for a seed") {
  constexpr int count = 4000;
  Vec3 left, right, head;
  float raised = 0;
  for (int i = 0; i < count; ++i) {
    Random random{std::uint64_t(i)}, again{std::uint64_t(i)};
    const PriorPose pose = prior_pose(random), same = prior_pose(again);
    CHECK(pose.head == same.head);
    for (const PriorLimbs& l : pose.limbs)
      for (const Vec3 d : {l.upper_arm, l.forearm, l.hand, l.thigh, l.calf, l.foot})
        CHECK(std::fabs(length(d) - 1) < 1e-5f);
    left += pose.limbs[0].upper_arm;
    right += pose.limbs[1].upper_arm;
    head += pose.head;
    raised += float(pose.head.x < -18 * degree);
  }
  // Means over draws of variance below 1/3: three standard deviations of each of the two.
  const float noise = 3 * std::sqrt(2.0f / 3 / count);
  CHECK(std::fabs(left.x + right.x) / count < noise);
  CHECK(std::fabs(left.y - right.y) / count < noise);
  CHECK(std::fabs(left.z - right.z) / count < noise);
  CHECK(std::fabs(head.y) / count < noise);
  CHECK(raised / count > 0.05f);
}

namespace {

// Hands of three bones side by side on the forearm, each with a finger, and a thumb beside them, as robots
// have. The thumb is on top: the palms face forwards, and fingers curl about the upright axis.
SkinnedMesh figure_with_parted_palms() {
  SkinnedMesh mesh = stick_figure();
  for (const float side : {1.0f, -1.0f}) {
    const std::string end = side > 0 ? "_l" : "_r";
    const std::int32_t fore = mesh.bones[bone_named(mesh, ("hand" + end).c_str())].parent;
    const auto add = [&](const std::string& name, std::int32_t parent, Vec3 origin) {
      Bone b;
      b.name = name + end;
      b.parent = parent;
      b.frame_rest.m[3] = side * origin.x;
      b.frame_rest.m[7] = origin.y;
      b.frame_rest.m[11] = origin.z;
      mesh.bones.push_back(b);
      return std::int32_t(mesh.bones.size() - 1);
    };
    const float wrist = std::fabs(origin(mesh, bone_named(mesh, ("hand" + end).c_str())).x);
    add("middle_01", std::int32_t(bone_named(mesh, ("hand" + end).c_str())), {wrist + 0.05f, 1.4f, 0});
    add("index_01", add("hand_upper", fore, {wrist, 1.43f, 0}), {wrist + 0.05f, 1.43f, 0});
    add("ring_01", add("hand_lower", fore, {wrist, 1.37f, 0}), {wrist + 0.05f, 1.37f, 0});
    add("thumb_01", fore, {wrist, 1.45f, 0.02f});
  }
  return mesh;
}

// The clavicles begin at a share of the way from the middle to the upper arm.
SkinnedMesh figure_with_clavicles(float share) {
  SkinnedMesh mesh = stick_figure();
  for (const char* end : {"_l", "_r"}) {
    const std::size_t arm = bone_named(mesh, (std::string("upperarm") + end).c_str());
    mesh.bones[bone_named(mesh, (std::string("clavicle") + end).c_str())].frame_rest.m[3] =
        share * mesh.bones[arm].frame_rest.m[3];
  }
  return mesh;
}

// The angle of the turn that takes one matrix to another.
float angle_between(const Mat3x4& a, const Mat3x4& b) {
  float trace = 0;
  for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    trace += dot(transform_vector(a, axis), transform_vector(b, axis));
  return std::acos(std::clamp(0.5f * (trace - 1), -1.0f, 1.0f));
}

}  // namespace

TEST_CASE("a palm of several bones stays whole, and its fingers curl towards the palm") {
  const SkinnedMesh mesh = figure_with_parted_palms();
  const std::vector<Joint> joints = joint_roles(mesh);
  const BodyTree tree = body_tree(mesh, joints);
  const std::vector<char> parted = parted_palms(joints, tree);
  const std::vector<Vec3> axis = curl_axes(mesh, joints, tree, {0, 1, 0});
  for (const char* name : {"hand_l", "hand_upper_l", "hand_lower_l", "hand_r"})
    CHECK(bool(parted[bone_named(mesh, name)]));
  for (const char* name : {"index_01_l", "middle_01_l", "ring_01_l", "index_01_r"}) {
    const std::size_t finger = bone_named(mesh, name);
    INFO(name);
    // The thumb stands a fifth beside the row of the knuckles.
    CHECK(std::fabs(axis[finger].y) > 0.95f);
  }
  CHECK(length(axis[bone_named(mesh, "thumb_01_l")]) > 0.9f);
  const std::size_t fore = std::size_t(mesh.bones[bone_named(mesh, "hand_upper_l")].parent);
  for (const Pose& pose : poses_of(mesh, 60))
    for (const char* name : {"hand_l", "hand_upper_l", "hand_lower_l"})
      // A chain of five turns rounds by less.
      CHECK(angle_between(pose[bone_named(mesh, name)], pose[fore]) < 2e-3f);
  CHECK_FALSE(JoinedHands(mesh, {}).possible());
  CHECK(differs_from_generation_4(mesh));
  // A hand of one bone has a wrist.
  const SkinnedMesh whole = figure_with_fingers();
  const std::vector<Joint> roles = joint_roles(whole);
  const std::vector<char> none = parted_palms(roles, body_tree(whole, roles));
  CHECK(std::count(none.begin(), none.end(), 1) == 0);
  CHECK_FALSE(differs_from_generation_4(whole));
}

TEST_CASE("clavicles at the shoulders swing with the arms, those at the breastbone shrug") {
  for (const float share : {0.2f, 0.9f}) {
    const SkinnedMesh mesh = figure_with_clavicles(share);
    const std::size_t clavicle = bone_named(mesh, "clavicle_l"), arm = bone_named(mesh, "upperarm_l"),
                      chest = bone_named(mesh, "spine_02");
    CHECK(differs_from_generation_4(mesh) == (share > 0.5f));
    double turn = 0, hanging = 0;
    const std::vector<Pose> poses = poses_of(mesh, 200);
    for (const Pose& pose : poses) {
      turn += double(angle_between(pose[clavicle], pose[chest])) / double(poses.size());
      hanging +=
          dot(transform_vector(pose[arm], {1, 0, 0}), transform_vector(pose[chest], {0, 1, 0})) < -0.8f;
    }
    // Shrugs have a mean of 12 degrees times 1.6. An arm swings by 60 degrees on average, its shoulder by
    // half of that or more.
    CHECK((turn > double(30 * degree)) == (share > 0.5f));
    CHECK(turn > double(8 * degree));
    // The arm points where the plan points it, whichever joint turns it.
    CHECK(hanging > 0.1 * double(poses.size()));
  }
}
