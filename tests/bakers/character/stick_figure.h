// A small person for the bakers' tests: a box round each bone, in a T-pose, 1.7 m tall, facing +z.
#pragma once

#include <string>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// With loose feet the rig keeps the feet at its root, as rigs with inverse kinematics do.
inline SkinnedMesh stick_figure(bool loose_feet = false) {
  SkinnedMesh mesh;
  const auto bone = [&](const std::string& name, std::int32_t parent, Vec3 origin) {
    Bone b;
    b.name = name;
    b.parent = parent;
    b.frame_rest.m[3] = origin.x;
    b.frame_rest.m[7] = origin.y;
    b.frame_rest.m[11] = origin.z;
    mesh.bones.push_back(b);
    return std::int32_t(mesh.bones.size()) - 1;
  };
  const auto box = [&](std::int32_t owner, Vec3 low, Vec3 high) {
    const auto first = std::uint32_t(mesh.vertex_count());
    for (int corner = 0; corner < 8; ++corner) {
      mesh.position.push_back(
          {corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z});
      SkinWeights w;
      w.bone[0] = std::uint16_t(owner);
      w.weight[0] = 1;
      mesh.weights.push_back(w);
      mesh.file_to_welded.push_back(first + std::uint32_t(corner));
    }
    static constexpr std::uint32_t face[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                                  {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                                  {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (const auto& f : face) mesh.triangle.push_back({first + f[0], first + f[1], first + f[2]});
  };
  const std::int32_t root = bone("root", -1, {0, 0, 0});
  const std::int32_t pelvis = bone("pelvis", root, {0, 0.95f, 0});
  const std::int32_t spine = bone("spine_01", pelvis, {0, 1.05f, 0});
  const std::int32_t chest = bone("spine_02", spine, {0, 1.25f, 0});
  const std::int32_t neck = bone("neck", chest, {0, 1.45f, 0});
  const std::int32_t head = bone("head", neck, {0, 1.52f, 0});
  box(pelvis, {-0.12f, 0.88f, -0.08f}, {0.12f, 1.04f, 0.08f});
  box(spine, {-0.1f, 1.05f, -0.07f}, {0.1f, 1.24f, 0.07f});
  box(chest, {-0.11f, 1.25f, -0.08f}, {0.11f, 1.44f, 0.08f});
  box(neck, {-0.04f, 1.45f, -0.04f}, {0.04f, 1.51f, 0.04f});
  box(head, {-0.08f, 1.52f, -0.09f}, {0.08f, 1.72f, 0.11f});
  for (const float side : {1.0f, -1.0f}) {
    const std::string end = side > 0 ? "_l" : "_r";
    const auto limb = [&](std::int32_t owner, Vec3 low, Vec3 high) {
      box(owner, {side > 0 ? low.x : -high.x, low.y, low.z}, {side > 0 ? high.x : -low.x, high.y, high.z});
    };
    const std::int32_t clavicle = bone("clavicle" + end, chest, {side * 0.03f, 1.4f, 0});
    const std::int32_t upper = bone("upperarm" + end, clavicle, {side * 0.18f, 1.4f, 0});
    const std::int32_t lower = bone("lowerarm" + end, upper, {side * 0.46f, 1.4f, 0});
    const std::int32_t hand = bone("hand" + end, lower, {side * 0.71f, 1.4f, 0});
    const std::int32_t thigh = bone("thigh" + end, pelvis, {side * 0.09f, 0.9f, 0});
    const std::int32_t calf = bone("calf" + end, thigh, {side * 0.09f, 0.48f, 0});
    const std::int32_t foot = bone("foot" + end, loose_feet ? root : calf, {side * 0.09f, 0.08f, 0});
    bone("ball" + end, foot, {side * 0.09f, 0.03f, 0.13f});
    limb(upper, {0.19f, 1.35f, -0.05f}, {0.45f, 1.45f, 0.05f});
    limb(lower, {0.46f, 1.36f, -0.04f}, {0.7f, 1.44f, 0.04f});
    limb(hand, {0.71f, 1.38f, -0.04f}, {0.88f, 1.42f, 0.05f});
    limb(thigh, {0.02f, 0.5f, -0.07f}, {0.16f, 0.88f, 0.07f});
    limb(calf, {0.04f, 0.1f, -0.05f}, {0.14f, 0.47f, 0.05f});
    limb(foot, {0.05f, 0, -0.06f}, {0.13f, 0.08f, 0.2f});
  }
  mesh.primitives.push_back({"person", 0, std::uint32_t(mesh.vertex_count())});
  return mesh;
}

}  // namespace nook::bake
