// A small skinned body for the bakers' tests: a closed tube along x with two bones, the joint in its middle.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/character/pose_sets.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// length and radius in metres; rings x segments + 2 vertices, two caps.
inline SkinnedMesh bending_tube(int rings = 24, int segments = 12, float length = 1, float radius = 0.1f) {
  SkinnedMesh mesh;
  mesh.bones.resize(2);
  mesh.bones[0].name = "root";
  mesh.bones[1].name = "tip";
  mesh.bones[1].parent = 0;
  mesh.bones[1].frame_rest.m[3] = 0.5f * length;
  const auto add = [&](float x, float y, float z) {
    mesh.position.push_back({x, y, z});
    SkinWeights w;
    const float tip = std::clamp((x / length - 0.4f) / 0.2f, 0.0f, 1.0f);
    w.bone = {std::uint16_t(tip > 0.5f), std::uint16_t(tip <= 0.5f)};
    w.weight = {std::max(tip, 1 - tip), std::min(tip, 1 - tip)};
    mesh.weights.push_back(w);
  };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < segments; ++s) {
      const float a = 2 * std::numbers::pi_v<float> * float(s) / float(segments);
      add(length * float(r) / float(rings - 1), radius * std::cos(a), radius * std::sin(a));
    }
  add(-0.5f * radius, 0, 0);
  add(length + 0.5f * radius, 0, 0);
  const auto at = [&](int r, int s) { return std::uint32_t(r * segments + s % segments); };
  const auto start = std::uint32_t(rings * segments), end = start + 1;
  for (int s = 0; s < segments; ++s) {
    for (int r = 0; r + 1 < rings; ++r) {
      mesh.triangle.push_back({at(r, s), at(r, s + 1), at(r + 1, s)});
      mesh.triangle.push_back({at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)});
    }
    mesh.triangle.push_back({at(0, s + 1), at(0, s), start});
    mesh.triangle.push_back({at(rings - 1, s), at(rings - 1, s + 1), end});
  }
  for (std::uint32_t i = 0; i < mesh.vertex_count(); ++i) mesh.file_to_welded.push_back(i);
  mesh.primitives.push_back({"tube", 0, std::uint32_t(mesh.vertex_count())});
  return mesh;
}

// count poses of the tube's joint, spread over all directions and up to 120 degrees.
inline std::vector<Pose> tube_poses(const SkinnedMesh& mesh, std::size_t count) {
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < count; ++i) {
    const float angle = 2.1f * float(i) / float(count), turn = 2.4f * float(i);
    const JointRotation joint{1, {0, angle * std::cos(turn), angle * std::sin(turn)}};
    poses.push_back(turn_joints(mesh, {&joint, 1}));
  }
  return poses;
}

}  // namespace nook::bake
