// A flat skinned body for the bakers' tests: a flag in the plane of x and y with four bones in a row along x.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bakers/character/pose_sets.h"
#include "bakers/import/weld.h"

namespace nook::bake {

enum class FlagSides { front, both };

// 1 m by 0.6 m. both: a back of its own, with vertices at the same places and the faces turned round.
inline SkinnedMesh flag(FlagSides sides) {
  constexpr int columns = 25, rows = 16, bones = 4;
  constexpr float length_m = 1, height_m = 0.6f;
  FileMesh file;
  for (int b = 0; b < bones; ++b) {
    Bone bone;
    bone.name = "bone_" + std::to_string(b);
    bone.parent = b - 1;
    bone.frame_rest.m[3] = length_m * float(b) / bones;
    file.bones.push_back(bone);
  }
  const int count = sides == FlagSides::both ? 2 : 1;
  for (int side = 0; side < count; ++side) {
    const auto first = std::uint32_t(file.position.size());
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c) {
        const float x = float(c) / (columns - 1);
        file.position.push_back({length_m * x, height_m * float(r) / (rows - 1), 0});
        // Each bone holds the stretch after its joint; the next one takes over linearly.
        const float along = std::clamp(bones * x - 0.5f, 0.0f, bones - 1.0f);
        const auto bone = std::uint16_t(std::min(along, bones - 2.0f));
        const std::vector<std::pair<std::uint16_t, float>> influences = {
            {bone, bone + 1 - along}, {std::uint16_t(bone + 1), along - bone}};
        file.weights.push_back(make_weights(influences));
      }
    const auto at = [&](int r, int c) { return first + std::uint32_t(r * columns + c); };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      if (side == 0)
        file.triangle.push_back({a, b, c});
      else
        file.triangle.push_back({a, c, b});
    };
    for (int r = 0; r + 1 < rows; ++r)
      for (int c = 0; c + 1 < columns; ++c) {
        add(at(r, c), at(r, c + 1), at(r + 1, c));
        add(at(r, c + 1), at(r + 1, c + 1), at(r + 1, c));
      }
  }
  std::vector<std::string> warnings;
  return weld(std::move(file), warnings, NOOK_ERROR_INVALID_ARGUMENT);
}

// Every joint turned about the flag's height, each to an angle of its own, as in a wind: up to 100 degrees.
inline std::vector<Pose> flag_poses(const SkinnedMesh& mesh, std::size_t count, float phase) {
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<JointRotation> joints;
    for (std::uint16_t b = 1; b < mesh.bones.size(); ++b)
      joints.push_back(
          {b, {0, 1.75f * std::sin(phase + 2.39996f * float(i) * float(b) + 0.7f * float(b)), 0}});
    poses.push_back(turn_joints(mesh, joints));
  }
  return poses;
}

}  // namespace nook::bake
