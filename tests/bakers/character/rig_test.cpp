// The reading of rigs: roles, partners and parents of bodies with planted answers, and what automatic
// poses do to them.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "bakers/character/animal_poses.h"
#include "bakers/character/auto_poses.h"
#include "bakers/character/hands.h"
#include "bakers/character/rig_file.h"
#include "bakers/character/rig_geometry.h"
#include "bakers/character/rotation.h"
#include "bakers/character/torn_edges.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/character/stick_figure.h"
#include "tests/bakers/character/tube_rigs.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

std::size_t find_bone(const SkinnedMesh& mesh, const std::string& name) {
  for (std::size_t b = 0; b < mesh.bones.size(); ++b)
    if (mesh.bones[b].name == name) return b;
  FAIL("no bone " << name);
  return 0;
}

using Roles = std::map<std::string, JointRole>;

void check_roles(const SkinnedMesh& mesh, const Roles& planted) {
  const std::vector<Joint> joints = joint_roles(mesh);
  for (const auto& [name, role] : planted) {
    INFO(name << ": " << name_of(joints[find_bone(mesh, name)].role));
    CHECK(joints[find_bone(mesh, name)].role == role);
  }
}

void check_partners(const SkinnedMesh& mesh, const std::map<std::string, std::string>& planted) {
  const std::vector<Joint> joints = joint_roles(mesh);
  const BodySides sides = body_sides(mesh, body_tree(mesh, joints).parent);
  for (const auto& [a, b] : planted) {
    INFO(a << " and " << b);
    CHECK(sides.partner[find_bone(mesh, a)] == std::int32_t(find_bone(mesh, b)));
    CHECK(sides.partner[find_bone(mesh, b)] == std::int32_t(find_bone(mesh, a)));
    if (a != b) CHECK(joints[find_bone(mesh, a)].side != joints[find_bone(mesh, b)].side);
  }
}

std::vector<Pose> poses_of(const SkinnedMesh& mesh, std::size_t count, std::uint64_t seed = 3) {
  return auto_poses(mesh, vertex_areas(mesh, mesh.position), count, seed);
}

std::size_t leg_count(const SkinnedMesh& mesh) {
  const std::vector<Joint> joints = joint_roles(mesh);
  return AnimalRig(mesh, joints).legs().size();
}

bool are_equal(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t p = 0; p < a.size(); ++p)
    for (std::size_t i = 0; i < a[p].size(); ++i)
      if (!std::equal(std::begin(a[p][i].m), std::end(a[p][i].m), std::begin(b[p][i].m))) return false;
  return a.size() > 0;
}

// No edge may tear: these bodies have no elbows so sharp that skin stretches by itself.
void check_whole(const SkinnedMesh& mesh) {
  CHECK(torn_share(mesh, poses_of(mesh, 60)) <= 0.0005);
}

constexpr JointRole leg = JointRole::leg, foot = JointRole::foot, spine = JointRole::spine,
                    tail = JointRole::tail, head = JointRole::head;

}  // namespace

TEST_CASE("a torn pose is found by the edges that it tears") {
  const SkinnedMesh mesh = quadruped();
  const std::size_t end = find_bone(mesh, "end_front_l");
  Pose pose(mesh.bones.size());
  CHECK(torn_share(mesh, std::vector<Pose>{pose}) == 0);
  pose[end].m[3] += 1;
  // Four sides and four diagonals join the foot's ring to the leg's.
  const double edges = double(mesh_edges(mesh).size());
  CHECK(torn_share(mesh, std::vector<Pose>{pose}) == Approx(8 / edges));
  // Stretched by less than 1 % of the diagonal, an edge is whole however short it is.
  pose[end].m[3] = 0.005f;
  CHECK(torn_share(mesh, std::vector<Pose>{pose}) == 0);
  CHECK(torn_share(mesh, {}) == 0);
}

TEST_CASE("four legs have four limbs whatever the rig is named and wherever it keeps its feet") {
  for (const Quadruped kind : {Quadruped{}, Quadruped{true, true, false}, Quadruped{false, true, true},
                               Quadruped{true, false, true}}) {
    const SkinnedMesh mesh = quadruped(kind), named = quadruped({kind.loose_feet, true, kind.twists});
    CAPTURE(kind.loose_feet, kind.named, kind.twists);
    const std::vector<Joint> joints = joint_roles(mesh);
    const BodyTree tree = body_tree(mesh, joints);
    const BodySides sides = body_sides(mesh, tree.parent);
    std::vector<std::int32_t> limbs;
    for (const char* which : {"_front_l", "_front_r", "_rear_l", "_rear_r"}) {
      INFO(which);
      const std::size_t upper = find_bone(named, std::string("upper") + which),
                        lower = find_bone(named, std::string("lower") + which),
                        end = find_bone(named, std::string("end") + which);
      CHECK(joints[upper].role == leg);
      CHECK(joints[lower].role == leg);
      CHECK(joints[end].role == foot);
      CHECK(tree.parent[end] == std::int32_t(lower));
      CHECK(joints[end].limb == joints[upper].limb);
      limbs.push_back(joints[upper].limb);
      CHECK(joints[end].side == (which[std::string(which).size() - 1] == 'l' ? Side::left : Side::right));
      std::string other = which;
      other.back() = other.back() == 'l' ? 'r' : 'l';
      CHECK(sides.partner[end] == std::int32_t(find_bone(named, "end" + other)));
      if (kind.twists)
        CHECK(joints[find_bone(named, std::string("twist") + which)].role == JointRole::control);
    }
    CHECK(limbs == std::vector<std::int32_t>{0, 1, 2, 3});
    for (const char* name : {"tail1", "tail2", "tail3"}) CHECK(joints[find_bone(named, name)].role == tail);
    CHECK(joints[find_bone(named, "head")].role == head);
    CHECK(joints[find_bone(named, "neck")].role == JointRole::neck);
    CHECK(joints[find_bone(named, "body_mid")].role == spine);
    CHECK_FALSE(is_person(mesh, named_roles(mesh)));
    check_whole(mesh);
  }
}

TEST_CASE("six and eight legs are counted, and their rows have partners") {
  for (const int pairs : {3, 4}) {
    const SkinnedMesh mesh = crawler(pairs);
    CHECK(leg_count(mesh) == std::size_t(2 * pairs));
    for (int p = 0; p < pairs; ++p) {
      const std::string n = std::to_string(p);
      check_roles(mesh, {{"c" + n + "a", leg}, {"f" + n + "a", leg}, {"t" + n + "b", leg}});
      check_partners(mesh, {{"t" + n + "a", "t" + n + "b"}});
    }
    check_roles(mesh, {{"head", head}});
    check_whole(mesh);
  }
}

TEST_CASE("birds have wings, dinosaurs arms, and both have jaws and tails without names") {
  const SkinnedMesh bird = two_legged(true), dinosaur = two_legged(false);
  const Roles shared{{"u_L", leg},    {"l_R", leg},   {"e_L", foot},         {"x1", tail},
                     {"x3", tail},    {"head", head}, {"j", JointRole::jaw}, {"n1", JointRole::neck},
                     {"chest", spine}};
  for (const SkinnedMesh& mesh : {bird, dinosaur}) {
    check_roles(mesh, shared);
    check_partners(mesh, {{"u_L", "u_R"}, {"a2_L", "a2_R"}, {"head", "head"}});
    CHECK(leg_count(mesh) == 2);
    check_whole(mesh);
  }
  check_roles(bird, {{"a1_L", JointRole::wing}, {"a2_R", JointRole::wing}});
  check_roles(dinosaur, {{"a1_L", JointRole::arm}, {"a2_R", JointRole::arm}});
}

TEST_CASE("a snake is one spine and bends along it") {
  const SkinnedMesh snake = chain_body(12);
  check_roles(snake, {{"s1", spine}, {"s6", spine}, {"s11", spine}});
  CHECK(leg_count(snake) == 0);
  check_whole(snake);
  float bent = 0;
  for (const Pose& pose : poses_of(snake, 40))
    bent = std::max(bent, length(transform_vector(pose.back(), {0, 0, 1}) - Vec3{0, 0, 1}));
  CHECK(bent > 0.5f);  // half a radian between tail and head is little for a snake
}

TEST_CASE("people keep their names' roles, and a hip above a thigh is one leg") {
  const SkinnedMesh person = stick_figure(true);
  CHECK(is_person(person, named_roles(person)));
  check_roles(person, {{"thigh_l", JointRole::thigh}, {"foot_r", JointRole::foot}});
  const std::vector<Joint> joints = joint_roles(person);
  CHECK(joints[find_bone(person, "foot_l")].parent == std::int32_t(find_bone(person, "calf_l")));
}

TEST_CASE("a club on a finger keeps the finger still") {
  SkinnedMesh mesh = stick_figure();
  const std::size_t hand = find_bone(mesh, "hand_l");
  for (const bool club : {false, true}) {
    SkinnedMesh own = mesh;
    Bone finger;
    finger.name = "index_01_l";
    finger.parent = std::int32_t(hand);
    finger.frame_rest.m[3] = 0.80f;
    finger.frame_rest.m[7] = 1.4f;
    own.bones.push_back(finger);
    for (const Vec3 p : {Vec3{0.80f, 1.4f, 0}, Vec3{0.88f, 1.4f, 0}, Vec3{0.82f, club ? 2.2f : 1.41f, 0}}) {
      SkinWeights w;
      w.bone[0] = std::uint16_t(own.bones.size() - 1);
      w.weight[0] = 1;
      own.file_to_welded.push_back(std::uint32_t(own.vertex_count()));
      own.position.push_back(p);
      own.weights.push_back(w);
    }
    const auto last = std::uint32_t(own.vertex_count());
    own.triangle.push_back({last - 3, last - 2, last - 1});
    const std::vector<Joint> joints = joint_roles(own);
    CHECK(bool(laden_fingers(own, joints, body_tree(own, joints)).back()) == club);
    bool moves = false;
    for (const Pose& pose : poses_of(own, 30))
      moves = moves || length(transform_vector(pose.back(), {1, 0, 0}) -
                              transform_vector(pose[hand], {1, 0, 0})) > 1e-3f;
    CHECK(moves == !club);
  }
}

TEST_CASE("a sword that nothing joins to the body is a prop of the limb that it is near") {
  TubeRig rig;
  rig.mesh = two_legged(false);
  TubeRig whole;
  whole.mesh = rig.mesh;
  // Bones of the copied body have no rings to join; a sword needs none.
  Bone sword;
  sword.name = "thing";
  sword.parent = std::int32_t(find_bone(whole.mesh, "a2_L"));
  sword.frame_rest.m[3] = 0.24f;
  sword.frame_rest.m[7] = 0.75f;
  sword.frame_rest.m[11] = 0.6f;
  whole.mesh.bones.push_back(sword);
  const auto first = std::uint32_t(whole.mesh.vertex_count());
  for (const Vec3 p : {Vec3{0.24f, 0.75f, 0.6f}, Vec3{0.25f, 0.75f, 0.6f}, Vec3{0.24f, 0.8f, 1.3f}}) {
    SkinWeights w;
    w.bone[0] = std::uint16_t(whole.mesh.bones.size() - 1);
    w.weight[0] = 1;
    whole.mesh.file_to_welded.push_back(std::uint32_t(whole.mesh.vertex_count()));
    whole.mesh.position.push_back(p);
    whole.mesh.weights.push_back(w);
  }
  whole.mesh.triangle.push_back({first, first + 1, first + 2});
  check_roles(whole.mesh, {{"thing", JointRole::prop}, {"a2_L", JointRole::arm}});
}

TEST_CASE("poses of animals are the same for a seed, and differ for another") {
  const SkinnedMesh mesh = quadruped({true, true, true});
  CHECK(are_equal(poses_of(mesh, 40), poses_of(mesh, 40)));
  CHECK_FALSE(are_equal(poses_of(mesh, 40), poses_of(mesh, 40, 4)));
}

TEST_CASE("a leg reaches the place that its foot is given") {
  const SkinnedMesh mesh = quadruped();
  const std::vector<Joint> joints = joint_roles(mesh);
  const AnimalRig rig(mesh, joints);
  REQUIRE(rig.legs().size() == 4);
  for (const LegChain& chain : rig.legs())
    for (const Vec3 move : {Vec3{0, 0.1f, 0}, Vec3{0.02f, 0.05f, 0.15f}, Vec3{0, 0.2f, -0.2f}}) {
      const std::vector<Mat3x4> turns = rig.reach(chain, chain.end + move);
      Vec3 end = chain.end;
      for (std::size_t i = turns.size(); i-- > 0;) end = transform_point(turns[i], end);
      // 24 halvings of 3.2 radians leave single precision over two joints of a leg of 0.7 m.
      CHECK(length(end - (chain.end + move)) < 1e-4f);
    }
}

TEST_CASE("a joint that bends more than the others leaves the foot where it was") {
  const SkinnedMesh mesh = quadruped();
  const std::vector<Joint> joints = joint_roles(mesh);
  const AnimalRig rig(mesh, joints);
  REQUIRE(rig.legs().size() == 4);
  const LegChain& chain = rig.legs().front();
  REQUIRE(chain.bones.size() >= 2);
  const Vec3 place = chain.end + Vec3{0, 0.15f, 0.05f};
  const std::vector<float> share(chain.bones.size() - 1, 1.5f);
  const std::vector<Mat3x4> turns = rig.reach(chain, place, share);
  Vec3 end = chain.end;
  for (std::size_t i = turns.size(); i-- > 0;) end = transform_point(turns[i], end);
  CHECK(length(end - place) < 1e-4f);  // as for the leg of the test above
}

namespace {

// The angles of a leg in one pose, seen from its hip's parent: radians to the front of its direction at rest.
float angle_of(const SkinnedMesh& mesh, const BodyTree& tree, const LegChain& chain, Vec3 forward,
               const Pose& pose) {
  const std::size_t hip = chain.bones.front();
  const Vec3 origin = joint_origin(mesh.bones[hip]);
  const Vec3 way = transform_point(pose[chain.bones.back()], chain.end) - transform_point(pose[hip], origin);
  const Vec3 own = transform_vector(inverse_rigid(pose[std::size_t(tree.parent[hip])]), way);
  const Vec3 rest = chain.end - origin;
  return std::atan2(dot(own, forward), -own.y) - std::atan2(dot(rest, forward), -rest.y);
}

}  // namespace

TEST_CASE("four legs gather under the belly and reach apart, as in a gallop") {
  const SkinnedMesh mesh = quadruped();
  const std::vector<Joint> joints = joint_roles(mesh);
  const BodyTree tree = body_tree(mesh, joints);
  const AnimalRig rig(mesh, joints);
  const Vec3 forward = body_frame(mesh, joints).forward;
  struct Counts {
    int gathered = 0, apart = 0;
  };
  // Poses in which all four legs are farther than 20 degrees, the least amplitude of a leap, from rest.
  const auto count = [&](std::span<const Pose> poses) {
    Counts counts;
    for (const Pose& pose : poses) {
      int under = 0, out = 0;
      for (const LegChain& chain : rig.legs()) {
        const float angle = angle_of(mesh, tree, chain, forward, pose) * (chain.row == 0 ? -1.0f : 1.0f);
        under += angle > 0.35f;
        out += angle < -0.35f;
      }
      counts.gathered += under == 4;
      counts.apart += out == 4;
    }
    return counts;
  };
  // An amplitude of 42 degrees, the mean, is beyond 20 degrees for a third of a cycle at each end. The lead
  // of one side and the spread of the legs leave more than a third of it.
  PoseRandom random(5);
  std::vector<Pose> leaps;
  for (int i = 0; i < 300; ++i) leaps.push_back(rig.pose(AnimalAct::leap, random));
  const Counts drawn = count(leaps);
  CHECK(drawn.gathered > 300 / 9);
  CHECK(drawn.apart > 300 / 9);
  // A quarter of the automatic poses leap. Where legs run into each other they are drawn again, but not all.
  const Counts kept = count(poses_of(mesh, 300));
  CHECK(kept.gathered >= 3);
  CHECK(kept.apart >= 3);
}

TEST_CASE("feet stay on the ground when the animal rests") {
  const SkinnedMesh mesh = quadruped();
  const std::size_t end = find_bone(mesh, "end_rear_l");
  std::size_t near = 0;
  const std::vector<Pose> poses = poses_of(mesh, 300);
  for (const Pose& pose : poses) {
    const Vec3 at = transform_point(pose[end], joint_origin(mesh.bones[end]));
    near += std::fabs(at.y - joint_origin(mesh.bones[end]).y) < 0.03f;
  }
  // All but a twelfth of the poses that rest, and the stance of gaits, which is a third of them or more.
  CHECK(double(near) > (rest_share * 0.9 + gait_share * 0.3) * 0.9 * double(poses.size()));
}

TEST_CASE("rigs of one bone and of 4,096 bones, and bones of one name, have poses") {
  for (const SkinnedMesh& mesh : {chain_body(1), chain_body(4096)}) {
    const std::vector<Pose> poses = poses_of(mesh, 2);
    for (const Pose& pose : poses)
      for (const Mat3x4& m : pose) CHECK(std::isfinite(m.m[3] + m.m[7] + m.m[11]));
  }
  SkinnedMesh same = quadruped();
  for (Bone& bone : same.bones) bone.name = "bone -> bone";
  CHECK(leg_count(same) == 4);
  check_whole(same);
}

TEST_CASE("a rig file corrects roles, limbs and parents, and comes back from its text") {
  const SkinnedMesh mesh = quadruped();
  const RigCorrections rig = read_rig(mesh, R"({"bones": {
    "tail1": {"role": "spine"},
    "upper_front_l": {"role": "arm", "limb": 7, "side": "right", "parent": "body_mid"}}})");
  CHECK(read_rig(mesh, rig_text(mesh, rig)) == rig);
  CHECK(rig_text(mesh, {}).empty());
  const std::vector<Joint> joints = joint_roles(mesh, rig);
  const Joint& arm = joints[find_bone(mesh, "upper_front_l")];
  CHECK(joints[find_bone(mesh, "tail1")].role == spine);
  CHECK(arm.role == JointRole::arm);
  CHECK(arm.side == Side::right);
  CHECK(arm.limb == 7);
  CHECK(arm.parent == std::int32_t(find_bone(mesh, "body_mid")));
}

TEST_CASE("rig files that say nothing clear are refused") {
  const SkinnedMesh mesh = quadruped();
  const auto refused = [&](const char* text, const char* says) {
    INFO(text);
    try {
      read_rig(mesh, text);
      FAIL("accepted");
    } catch (const Failure& failure) {
      CHECK(failure.code() == NOOK_ERROR_INVALID_ARGUMENT);
      INFO(failure.what());
      CHECK(std::string(failure.what()).find(says) != std::string::npos);
    }
  };
  refused("{", "not JSON");
  refused("[]", "\"bones\"");
  refused(R"({"bones": []})", "\"bones\"");
  refused(R"({"bones": {}})", "\"bones\" is empty");
  refused(R"({"bones": {"tail1": {}}, "bone": 1})", "unknown key \"bone\"");
  refused(R"({"bones": {"tail9": {}}})", "no bone is named \"tail9\"");
  refused(R"({"bones": {"tail1": 3}})", "not an object");
  refused(R"({"bones": {"tail1": {"rolle": "leg"}}})", "unknown key \"rolle\"");
  refused(R"({"bones": {"tail1": {"role": "flipper"}}})", "unknown role");
  refused(R"({"bones": {"tail1": {"side": 1}}})", "unknown side");
  refused(R"({"bones": {"tail1": {"limb": 1.5}}})", "limb");
  refused(R"({"bones": {"tail1": {"limb": 99999999999}}})", "limb");
  refused(R"({"bones": {"tail1": {"parent": 3}}})", "not a name");
  refused(R"({"bones": {"tail1": {"parent": "tail3"}}})", "is its own ancestor");
  SkinnedMesh twice = mesh;
  twice.bones[2].name = twice.bones[1].name = "bone";
  try {
    read_rig(twice, R"({"bones": {"bone": {}}})");
    FAIL("accepted");
  } catch (const Failure& failure) {
    CHECK(std::string(failure.what()).find("two bones are named") != std::string::npos);
  }
}
