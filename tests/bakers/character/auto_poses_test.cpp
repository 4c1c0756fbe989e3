// The poses that a bake makes without clips: what they reach, and that they hang together.
#include "bakers/character/auto_poses.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/character/body_tree.h"
#include "bakers/character/pose_prior.h"
#include "bakers/character/self_collision.h"
#include "bakers/import/skinning.h"
#include "tests/bakers/character/stick_figure.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

constexpr float degree = std::numbers::pi_v<float> / 180;

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
