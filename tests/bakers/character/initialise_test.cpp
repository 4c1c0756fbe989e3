// Where a fit begins: spheres inside the flesh, clusters that keep together, roles of bones, poses.
#include "bakers/character/initialise.h"

#include <algorithm>
#include <set>

#include "bakers/character/auto_poses.h"
#include "bakers/character/linear_fit.h"
#include "bakers/character/rig_anatomy.h"
#include "bakers/character/self_collision.h"
#include "bakers/import/skinned_mesh.h"
#include "tests/bakers/character/bending_tube.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

TEST_CASE("initial spheres lie on the axis of each bone's flesh") {
  const SkinnedMesh mesh = bending_tube();
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  const std::vector<InitialSphere> spheres = initial_spheres(mesh, area, 12);
  CHECK(spheres.size() == 12);
  for (const InitialSphere& s : spheres) {
    CHECK(std::abs(s.centre.y) < 0.01f);  // the tube is round: 12 segments leave rounding errors only
    CHECK(std::abs(s.centre.z) < 0.01f);
    CHECK(s.radius > 0.05f);  // points on a round skin of radius 0.1 spread by 0.1 / sqrt 2 across
    CHECK(s.radius < 0.1f);
    CHECK((s.bone == 0 ? s.centre.x < 0.6f : s.centre.x > 0.4f));
  }
}

TEST_CASE("key points crowd where AO changes with the pose") {
  const SkinnedMesh mesh = bending_tube();
  const auto changes = [&](std::size_t i) { return mesh.position[i].x > 0.5f; };
  // AO of the far half is 0.25 and 0.75 in turns, which has the variance 1/16; AO of the near half is 0.6.
  constexpr std::size_t poses = 4;
  AoTargets targets;
  targets.vertex_count = mesh.vertex_count();
  std::size_t changing = 0;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) changing += changes(i);
  for (std::size_t t = 0; t < poses; ++t)
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
      targets.value.push_back(
          std::uint16_t((changes(i) ? (t % 2 ? 0.75f : 0.25f) : 0.6f) / AoTargets::scale));
  targets.value.resize(targets.value.size() + mesh.vertex_count(),
                       0);  // a held-out pose, which does not count
  const std::vector<float> given(mesh.vertex_count(), 2.0f);
  const std::vector<float> weight = placement_weights(given, targets, poses);
  const float over_mean = float(mesh.vertex_count()) / float(changing);
  for (std::size_t i = 0; i < weight.size(); ++i)  // a step of the targets is 1.5e-5
    CHECK(std::abs(weight[i] - 2 * (0.05f + (changes(i) ? over_mean : 0.0f))) < 1e-3f);

  std::vector<Vec3> normal;
  vertex_normals(mesh.triangle, mesh.position, normal);
  ClusterSettings settings;
  settings.count = 30;
  const auto far_clusters = [&](const std::vector<float>& w) {
    std::set<std::uint32_t> far;
    const std::vector<std::uint32_t> cluster = cluster_vertices(mesh, w, normal, settings);
    for (std::size_t i = 0; i < cluster.size(); ++i)
      if (changes(i)) far.insert(cluster[i]);
    return far.size();
  };
  CHECK(far_clusters(given) < 20);
  CHECK(far_clusters(weight) > 20);

  // Where nothing changes, the weights are those given.
  CHECK(placement_weights(given, targets, 1) == given);
}

TEST_CASE("clusters are connected and have the given number") {
  const SkinnedMesh mesh = bending_tube();
  std::vector<Vec3> normal;
  vertex_normals(mesh.triangle, mesh.position, normal);
  const std::vector<float> weight(mesh.vertex_count(), 1.0f);
  ClusterSettings settings;
  settings.count = 20;
  const std::vector<std::uint32_t> cluster = cluster_vertices(mesh, weight, normal, settings);
  CHECK(std::set<std::uint32_t>(cluster.begin(), cluster.end()).size() == 20);
  for (std::uint32_t c = 0; c < 20; ++c) {
    // Flood along edges from one member must reach all members (the tube has no parts that only lie near).
    std::set<std::uint32_t> members, reached;
    for (std::uint32_t i = 0; i < cluster.size(); ++i)
      if (cluster[i] == c) members.insert(i);
    reached.insert(*members.begin());
    for (std::size_t before = 0; before != reached.size();) {
      before = reached.size();
      for (const auto& t : mesh.triangle)
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b)
            if (reached.count(t[std::size_t(a)]) && members.count(t[std::size_t(b)]))
              reached.insert(t[std::size_t(b)]);
    }
    CHECK(reached == members);
  }
}

TEST_CASE("with centres of rotation, no normal of a limb points towards its axis") {
  const SkinnedMesh mesh = bending_tube();
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  std::vector<Vec3> normal;
  vertex_normals(mesh.triangle, mesh.position, normal);
  const std::vector<Vec3> cor = centre_of_rotation_normals(mesh, area, normal);
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    CHECK(std::abs(length(cor[i]) - 1) < 1e-4f);
    const float side = dot(cor[i], {0, mesh.position[i].y, mesh.position[i].z});
    CHECK(side >= -1e-4f);
  }
}

TEST_CASE("a planted linear layer is recovered") {
  // Shadows of 6 key points over 200 poses, and vertices that are known mixtures of two of them.
  TrainingSet set;
  constexpr std::size_t poses = 200, padded = 16, vertices = 30;
  set.poses.resize(poses);
  set.targets.vertex_count = vertices;
  std::vector<float> shadow(poses * padded, 0.0f);
  std::uint64_t counter = 1;
  for (std::size_t t = 0; t < poses; ++t)
    for (std::size_t k = 0; k < 6; ++k) shadow[t * padded + k] = 0.6f * unit_float(mix_bits(counter++));
  const auto truth = [&](std::size_t t, std::size_t i) {
    return 0.9f - 0.5f * shadow[t * padded + i % 6] - 0.3f * shadow[t * padded + (i + 2) % 6];
  };
  for (std::size_t t = 0; t < poses; ++t)
    for (std::size_t i = 0; i < vertices; ++i)
      set.targets.value.push_back(std::uint16_t(truth(t, i) * 65535 + 0.5f));
  Candidates candidates;
  candidates.count = 6;
  for (std::size_t i = 0; i < vertices; ++i)
    for (std::uint16_t k = 0; k < 6; ++k) candidates.key_point.push_back(k);
  LinearFitSettings settings;
  settings.entries = 3;
  settings.ridge = 1e-9;
  settings.anchor_floor = 0;
  const LinearLayerFit fit = fit_linear_layer(shadow, padded, set, candidates, settings);
  for (std::size_t i = 0; i < vertices; ++i) {
    std::vector<float> alpha(6, 0.0f);
    for (std::size_t s = 0; s < 3; ++s) {
      CHECK(fit.alpha[3 * i + s] >= 0);
      alpha[fit.key_point[3 * i + s]] += fit.alpha[3 * i + s];
    }
    // 16-bit targets and float sums leave errors of about 1e-4.
    CHECK(std::abs(alpha[i % 6] - 0.5f) < 2e-3f);
    CHECK(std::abs(alpha[(i + 2) % 6] - 0.3f) < 2e-3f);
    CHECK(std::abs(fit.bias[i] - 0.1f) < 2e-3f);
  }
}

TEST_CASE("common rigs are understood") {
  SkinnedMesh mesh;
  const auto add = [&](const char* name, std::int32_t parent) {
    mesh.bones.push_back({name, parent, {}});
    return std::int32_t(mesh.bones.size() - 1);
  };
  const std::int32_t pelvis = add("Bip01 Pelvis", -1);
  const std::int32_t thigh = add("DEF-thigh.L", pelvis), calf = add("DEF-shin.L", thigh);
  const std::int32_t spine = add("spine_01", pelvis), clavicle = add("mixamorig:LeftShoulder", spine);
  const std::int32_t arm = add("mixamorig:LeftArm", clavicle), fore = add("mixamorig:LeftForeArm", arm);
  const std::int32_t hand = add("Bip01 R Hand", fore), thumb = add("Bip01 R Finger0", hand);
  const std::int32_t thumb_tip = add("Bip01 R Finger01", thumb), finger = add("index_01_l", hand);
  const std::vector<Joint> joints = joint_roles(mesh);
  const auto role = [&](std::int32_t b) { return joints[std::size_t(b)].role; };
  CHECK(role(pelvis) == JointRole::pelvis);
  CHECK(role(thigh) == JointRole::thigh);
  CHECK(joints[std::size_t(thigh)].side == Side::left);
  CHECK(joints[std::size_t(thigh)].continuation == calf);
  CHECK(role(calf) == JointRole::calf);
  CHECK(role(spine) == JointRole::spine);
  CHECK(role(clavicle) == JointRole::clavicle);
  CHECK(role(arm) == JointRole::upper_arm);
  CHECK(role(fore) == JointRole::forearm);
  CHECK(role(hand) == JointRole::hand);
  CHECK(joints[std::size_t(hand)].side == Side::right);
  CHECK(role(thumb) == JointRole::thumb);
  CHECK(joints[std::size_t(thumb_tip)].segment == 1);
  CHECK(role(finger) == JointRole::finger);
}

TEST_CASE("single-joint poses turn one joint and automatic poses are rigid and reproducible") {
  const SkinnedMesh mesh = bending_tube();
  const std::vector<std::uint32_t> joints = posable_joints(mesh);
  REQUIRE(joints.size() == 1);  // the root moves every vertex
  CHECK(joints[0] == 1);
  CHECK(single_joint_poses(mesh, 5, 0.785f).size() == 125);  // the rest pose once, 124 others
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  const std::vector<Pose> a = auto_poses(mesh, area, 10, 3), b = auto_poses(mesh, area, 10, 3);
  for (std::size_t p = 0; p < a.size(); ++p)
    for (std::size_t m = 0; m < a[p].size(); ++m) {
      CHECK(std::equal(a[p][m].m, a[p][m].m + 12, b[p][m].m));
      const Vec3 column{a[p][m].m[0], a[p][m].m[4], a[p][m].m[8]};
      CHECK(std::abs(length(column) - 1) < 1e-4f);
    }
}

TEST_CASE("self-collision is nothing at rest") {
  const SkinnedMesh mesh = bending_tube();
  const SelfCollision collision(mesh, vertex_areas(mesh, mesh.position));
  CHECK(collision.depth(Pose(2)) == 0);
}
