// Poses made of other poses: as joint motions, mirrored, mixed and blended.
#include "bakers/character/pose_variants.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "bakers/character/joint_motion.h"
#include "bakers/character/rotation.h"
#include "bakers/character/self_collision.h"
#include "bakers/import/gltf.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/random.h"
#include "tests/bakers/character/bending_tube.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

Vec3 mirrored_x(Vec3 v) {
  return {-v.x, v.y, v.z};
}

// Two tubes that point to the left and to the right of a common root, mirror images of each other: vertex i
// and vertex i + half are twins.
SkinnedMesh two_arms() {
  const SkinnedMesh tube = bending_tube();
  SkinnedMesh mesh = tube;
  const auto half = std::uint32_t(tube.vertex_count());
  const auto moved = [](Vec3 v) { return Vec3{v.x + 0.2f, v.y, v.z}; };
  for (Vec3& p : mesh.position) p = moved(p);
  mesh.bones[1].name = "arm_l";
  mesh.bones[1].frame_rest.m[3] += 0.2f;
  mesh.bones.push_back(mesh.bones[1]);
  mesh.bones[2].name = "arm_r";
  mesh.bones[2].frame_rest.m[3] *= -1;
  for (std::uint32_t i = 0; i < half; ++i) {
    mesh.position.push_back(mirrored_x(mesh.position[i]));
    SkinWeights w = mesh.weights[i];
    for (std::uint16_t& b : w.bone)
      if (b == 1) b = 2;
    mesh.weights.push_back(w);
    mesh.file_to_welded.push_back(half + i);
  }
  for (const auto& t : tube.triangle) mesh.triangle.push_back({t[0] + half, t[2] + half, t[1] + half});
  mesh.primitives[0].vertex_count = 2 * half;
  return mesh;
}

float largest_difference(const Pose& a, const Pose& b) {
  float most = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int k = 0; k < 12; ++k) most = std::max(most, std::fabs(a[i].m[k] - b[i].m[k]));
  return most;
}

// Poses with turns up to half a circle, shifts and scales.
std::vector<JointMotion> wild_motions(const SkinnedMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  const auto vector = [&](float size) {
    const float x = random.normal(), y = random.normal(), z = random.normal();
    return size * normalised({x, y, z});
  };
  std::vector<JointMotion> motions;
  for (std::size_t b = 0; b < mesh.bones.size(); ++b)
    motions.push_back({vector(random.between(0, 0.999f * std::numbers::pi_v<float>)),
                       vector(random.between(0, 0.3f)), random.between(0.5f, 2)});
  return motions;
}

std::filesystem::path shared_character(const char* file) {
  const char* assets = std::getenv("NOOK_ASSETS");
  return std::filesystem::path(assets ? assets : NOOK_ASSETS_DIR) / "characters" / file;
}

}  // namespace

TEST_CASE("a pose comes back from its joint motions") {
  const SkinnedMesh mesh = two_arms();
  const BodyTree tree = body_tree(mesh);
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Pose pose = pose_of(mesh, tree, wild_motions(mesh, seed));
    // Entries are below 10; single precision leaves about 1e-6 of that at each of a few products.
    CHECK(largest_difference(pose_of(mesh, tree, joint_motions(mesh, tree, pose)), pose) < 5e-5f);
  }
}

TEST_CASE("between two motions lie the ends, the middle of the shortest way, and what is beyond") {
  const JointMotion from{{0.2f, 0, 0}, {0, 1, 0}, 1}, to{{1.0f, 0, 0}, {0, 3, 0}, 4};
  const auto near = [](Vec3 a, Vec3 b) { return length(a - b) < 1e-5f; };
  CHECK(near(between(from, to, 0).turn, from.turn));
  CHECK(near(between(from, to, 1).turn, to.turn));
  CHECK(near(between(from, to, 0.5f).turn, {0.6f, 0, 0}));
  CHECK(near(between(from, to, 0.5f).shift, {0, 2, 0}));
  CHECK(std::fabs(between(from, to, 0.5f).scale - 2) < 1e-5f);
  CHECK(near(between(from, to, 1.5f).turn, {1.4f, 0, 0}));
  // From 170 degrees to -170 the shortest way leads over 180.
  const float degree = std::numbers::pi_v<float> / 180;
  const JointMotion a{{0, 170 * degree, 0}, {}, 1}, b{{0, -170 * degree, 0}, {}, 1};
  CHECK(std::fabs(length(between(a, b, 0.25f).turn) - 175 * degree) < 1e-4f);
}

TEST_CASE("a mirrored rig is found, and mirroring twice gives the pose back") {
  const SkinnedMesh mesh = two_arms();
  const BodyTree tree = body_tree(mesh);
  const auto mirror = find_mirror(mesh, tree);
  REQUIRE(mirror);
  CHECK(mirror->normal == Vec3{1, 0, 0});
  CHECK(mirror->twin == std::vector<std::uint32_t>{0, 2, 1});
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<JointMotion> motions = wild_motions(mesh, seed);
    const Pose there = pose_of(mesh, tree, mirrored(*mirror, motions));
    const Pose back = pose_of(mesh, tree, mirrored(*mirror, mirrored(*mirror, motions)));
    CHECK(largest_difference(back, pose_of(mesh, tree, motions)) == 0);
    // Each vertex lands on its twin's mirror image.
    std::vector<Vec3> posed, image;
    skin_positions(mesh, pose_of(mesh, tree, motions), posed);
    skin_positions(mesh, there, image);
    const std::size_t half = mesh.vertex_count() / 2;
    float most = 0;
    for (std::size_t i = 0; i < half; ++i)
      most = std::max(most, length(mirrored_x(posed[i]) - image[i + half]));
    CHECK(most < 1e-4f);
  }
}

TEST_CASE("AO of a mirrored pose is mirrored AO") {
  const SkinnedMesh mesh = two_arms();
  const BodyTree tree = body_tree(mesh);
  const auto mirror = find_mirror(mesh, tree);
  REQUIRE(mirror);
  std::vector<Pose> poses, images;
  for (const float angle : {0.8f, 1.6f, 2.4f}) {
    std::vector<JointMotion> motions(3);
    motions[1].turn = {0, 0, angle};
    motions[2].turn = {0, 0.5f * angle, 0.2f};
    poses.push_back(pose_of(mesh, tree, motions));
    images.push_back(pose_of(mesh, tree, mirrored(*mirror, motions)));
  }
  constexpr std::uint32_t rays = 256;
  const AoTargets a = trace_character_ao(mesh, poses, rays, 1), b = trace_character_ao(mesh, images, rays, 2);
  const std::size_t half = mesh.vertex_count() / 2;
  double sum = 0;
  for (std::size_t p = 0; p < poses.size(); ++p)
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
      const double d =
          double(AoTargets::scale) * (double(a.row(p)[i]) - double(b.row(p)[(i + half) % (2 * half)]));
      sum += d * d;
    }
  const double mse = sum / double(poses.size() * mesh.vertex_count());
  // The noise of both tracings adds up; the factor of 1.5 is for the error of the noise floor itself.
  CHECK(mse < 1.5 * 2 * measure_noise_floor(mesh, poses, a, rays, 1));
}

TEST_CASE("a rig without symmetry has no mirror") {
  SkinnedMesh mesh = two_arms();
  const BodyTree tree = body_tree(mesh);
  mesh.bones[2].frame_rest.m[7] = 0.4f;
  CHECK(!find_mirror(mesh, tree));
  CHECK(!find_mirror(SkinnedMesh{}, BodyTree{}));
}

TEST_CASE("variants are the same for a seed, have motions of the given poses, and keep out of themselves") {
  const SkinnedMesh mesh = two_arms();
  const BodyTree tree = body_tree(mesh);
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  std::vector<Pose> given;
  for (const float angle : {-0.5f, 0.25f, 0.5f}) {
    std::vector<JointMotion> motions(3);
    motions[1].turn = {0, 0, angle};
    motions[2].turn = {0, 0, 0.5f * angle};
    given.push_back(pose_of(mesh, tree, motions));
  }
  const std::vector<Pose> a = pose_variants(mesh, area, given, 60, 7),
                          b = pose_variants(mesh, area, given, 60, 7);
  const std::vector<Pose> other = pose_variants(mesh, area, given, 60, 8);
  REQUIRE(a.size() == 60);
  const SelfCollision collision(mesh, area);
  bool differs = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(largest_difference(a[i], b[i]) == 0);
    differs = differs || largest_difference(a[i], other[i]) > 0;
    CHECK(collision.depth(a[i]) <= 0.6f);
    for (const JointMotion& m : joint_motions(mesh, tree, a[i])) {
      // Blends end 0.3 of the way beyond an end: -0.5 - 0.3 * 1.
      CHECK(length(m.turn) < 0.81f);
      CHECK(std::fabs(m.turn.x) + std::fabs(m.turn.y) < 1e-4f);
    }
  }
  CHECK(differs);
  CHECK(pose_variants(mesh, area, {}, 5, 1).empty());
}

TEST_CASE("the shared bodies are symmetric, and their sides are twins") {
  for (const char* file :
       {"ual_mannequin_CC0.glb", "rocketbox_Female_Adult_01_MIT.glb", "robot_expressive_CC0.glb"}) {
    if (!std::filesystem::exists(shared_character(file))) {
      WARN("skipped: no " << shared_character(file).string());
      continue;
    }
    const ImportedCharacter character = import_gltf(shared_character(file));
    const auto mirror = find_mirror(character.mesh, body_tree(character.mesh));
    INFO(file);
    REQUIRE(mirror);
    CHECK(mirror->normal == Vec3{1, 0, 0});
    std::size_t pairs = 0;
    for (std::size_t b = 0; b < mirror->twin.size(); ++b) pairs += mirror->twin[b] > b;
    CHECK(3 * pairs > mirror->twin.size());  // two arms and two legs are most of a rig's joints
  }
}
