// Bodies of tubes for tests of rigs: each bone has a piece of a tube, and what hangs together in the body
// hangs together in the mesh.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

class TubeRig {
 public:
  SkinnedMesh mesh;

  std::int32_t bone(const std::string& name, std::int32_t parent, Vec3 origin) {
    Bone b;
    b.name = name;
    b.parent = parent;
    b.frame_rest.m[3] = origin.x;
    b.frame_rest.m[7] = origin.y;
    b.frame_rest.m[11] = origin.z;
    mesh.bones.push_back(b);
    ring_of_.push_back(0);
    return std::int32_t(mesh.bones.size()) - 1;
  }

  // Rings of four vertices at the joints of the bones in order, and at the tip.
  void tube(const std::vector<std::int32_t>& bones, Vec3 tip, float radius) {
    std::vector<Vec3> points;
    for (const std::int32_t b : bones) {
      const Mat3x4& f = mesh.bones[std::size_t(b)].frame_rest;
      points.push_back({f.m[3], f.m[7], f.m[11]});
    }
    points.push_back(tip);
    // Two rings a bone: at its joint and shortly before the next one.
    std::vector<std::uint32_t> rings;
    for (std::size_t i = 0; i < bones.size(); ++i) {
      const Vec3 along = points[i + 1] - points[i];
      rings.push_back(ring(bones[i], points[i], along, radius));
      ring_of_[std::size_t(bones[i])] = rings.back();
      rings.push_back(ring(bones[i], points[i] + 0.8f * along, along, radius));
    }
    rings.push_back(ring(bones.back(), tip, points.back() - points[points.size() - 2], radius));
    for (std::size_t r = 0; r + 1 < rings.size(); ++r)
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t a = rings[r] + k, b = rings[r] + (k + 1) % 4;
        const std::uint32_t c = rings[r + 1] + k, d = rings[r + 1] + (k + 1) % 4;
        mesh.triangle.push_back({a, b, c});
        mesh.triangle.push_back({b, d, c});
      }
  }

  // Joins the first rings of two bones by faces.
  void bridge(std::int32_t a, std::int32_t b) {
    const std::uint32_t i = ring_of_[std::size_t(a)], j = ring_of_[std::size_t(b)];
    mesh.triangle.push_back({i, i + 1, j});
    mesh.triangle.push_back({i + 1, j, j + 1});
  }

 private:
  std::uint32_t ring(std::int32_t bone, Vec3 at, Vec3 along, float radius) {
    const Vec3 any = std::fabs(along.x) < 0.7f * length(along) ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
    const Vec3 u = normalised(cross(along, any)), v = normalised(cross(along, u));
    const auto first = std::uint32_t(mesh.vertex_count());
    for (const Vec3 d : {u, v, -u, -v}) {
      SkinWeights w;
      w.bone[0] = std::uint16_t(bone);
      w.weight[0] = 1;
      mesh.file_to_welded.push_back(std::uint32_t(mesh.vertex_count()));
      mesh.position.push_back(at + radius * d);
      mesh.weights.push_back(w);
    }
    return first;
  }

  std::vector<std::uint32_t> ring_of_;
};

// The build of a four-legged body.
struct Quadruped {
  bool loose_feet = false;  // feet of the rig's root, as with inverse kinematics
  bool named = true;        // false: bones are numbered
  bool twists = false;      // a twist bone in each upper leg
};

// 1 m high, 1.6 m long, looking along +z: trunk of three bones, neck and head, tail of three, four legs of
// three bones each.
inline SkinnedMesh quadruped(const Quadruped& kind = {}) {
  TubeRig rig;
  int number = 0;
  const auto named = [&](const std::string& name) {
    return kind.named ? name : "Bone." + std::to_string(number++);
  };
  const std::int32_t root = rig.bone(named("root"), -1, {0, 0, 0});
  const std::int32_t hips = rig.bone(named("body_rear"), root, {0, 0.9f, -0.5f});
  const std::int32_t belly = rig.bone(named("body_mid"), hips, {0, 0.92f, -0.1f});
  const std::int32_t chest = rig.bone(named("body_front"), belly, {0, 0.94f, 0.3f});
  const std::int32_t neck = rig.bone(named("neck"), chest, {0, 1.0f, 0.6f});
  const std::int32_t head = rig.bone(named("head"), neck, {0, 1.25f, 0.8f});
  rig.tube({hips, belly, chest, neck, head}, {0, 1.25f, 1.05f}, 0.12f);
  std::vector<std::int32_t> tail{rig.bone(named("tail1"), hips, {0, 0.92f, -0.7f})};
  tail.push_back(rig.bone(named("tail2"), tail.back(), {0, 0.85f, -0.85f}));
  tail.push_back(rig.bone(named("tail3"), tail.back(), {0, 0.72f, -0.95f}));
  rig.tube(tail, {0, 0.6f, -1.0f}, 0.03f);
  rig.bridge(tail.front(), hips);
  for (const bool front : {true, false})
    for (const float side : {1.0f, -1.0f}) {
      const std::string end = std::string(front ? "_front" : "_rear") + (side > 0 ? "_l" : "_r");
      const float z = front ? 0.35f : -0.5f, bend = front ? 0.04f : -0.06f;
      const std::int32_t upper =
          rig.bone(named("upper" + end), front ? chest : hips, {0.14f * side, 0.8f, z});
      if (kind.twists) rig.bone(named("twist" + end), upper, {0.15f * side, 0.66f, z + 0.5f * bend});
      const std::int32_t lower = rig.bone(named("lower" + end), upper, {0.16f * side, 0.5f, z + bend});
      const std::int32_t foot =
          rig.bone(named("end" + end), kind.loose_feet ? root : lower, {0.16f * side, 0.1f, z});
      rig.tube({upper, lower, foot}, {0.16f * side, 0, z + 0.08f}, 0.05f);
      rig.bridge(upper, front ? chest : hips);
    }
  return rig.mesh;
}

// A flat round body with so many pairs of legs that stand out to the sides, 0.4 m high.
inline SkinnedMesh crawler(int pairs) {
  TubeRig rig;
  const std::int32_t body = rig.bone("b0", -1, {0, 0.3f, -0.3f});
  const std::int32_t front = rig.bone("b1", body, {0, 0.3f, 0.1f});
  const std::int32_t head = rig.bone("head", front, {0, 0.3f, 0.4f});
  rig.tube({body, front, head}, {0, 0.3f, 0.6f}, 0.1f);
  for (int pair = 0; pair < pairs; ++pair)
    for (const float side : {1.0f, -1.0f}) {
      const float z = 0.3f - 0.6f * float(pair) / float(pairs);
      const std::string end = std::to_string(pair) + (side > 0 ? "a" : "b");
      const std::int32_t holder = z > 0 ? front : body;
      const std::int32_t coxa = rig.bone("c" + end, holder, {0.1f * side, 0.3f, z});
      const std::int32_t femur = rig.bone("f" + end, coxa, {0.25f * side, 0.36f, z});
      const std::int32_t tibia = rig.bone("t" + end, femur, {0.5f * side, 0.4f, z});
      rig.tube({coxa, femur, tibia}, {0.7f * side, 0, z}, 0.03f);
      rig.bridge(coxa, holder);
    }
  return rig.mesh;
}

// A body on two legs that lies level: a tail behind, a neck before, and wings or small arms at the chest.
inline SkinnedMesh two_legged(bool wings) {
  TubeRig rig;
  const std::int32_t root = rig.bone("root", -1, {0, 0, 0});
  const std::int32_t hips = rig.bone("hips", root, {0, 1.0f, 0});
  const std::int32_t chest = rig.bone("chest", hips, {0, 1.05f, 0.4f});
  const std::int32_t neck = rig.bone("n1", chest, {0, 1.2f, 0.7f});
  const std::int32_t head = rig.bone("head", neck, {0, 1.45f, 0.85f});
  const std::int32_t jaw = rig.bone("j", head, {0, 1.38f, 0.9f});
  rig.tube({hips, chest, neck, head}, {0, 1.5f, 1.2f}, 0.12f);
  rig.tube({jaw}, {0, 1.34f, 1.15f}, 0.04f);
  rig.bridge(jaw, head);
  std::vector<std::int32_t> tail{rig.bone("x1", hips, {0, 1.0f, -0.3f})};
  tail.push_back(rig.bone("x2", tail.back(), {0, 0.98f, -0.7f}));
  tail.push_back(rig.bone("x3", tail.back(), {0, 0.95f, -1.1f}));
  rig.tube(tail, {0, 0.92f, -1.5f}, 0.06f);
  rig.bridge(tail.front(), hips);
  for (const float side : {1.0f, -1.0f}) {
    const std::string end = side > 0 ? "_L" : "_R";
    const std::int32_t upper = rig.bone("u" + end, hips, {0.18f * side, 0.9f, 0});
    const std::int32_t lower = rig.bone("l" + end, upper, {0.18f * side, 0.5f, 0.12f});
    const std::int32_t foot = rig.bone("e" + end, lower, {0.18f * side, 0.12f, 0});
    rig.tube({upper, lower, foot}, {0.18f * side, 0, 0.15f}, 0.06f);
    rig.bridge(upper, hips);
    const Vec3 at{0.14f * side, 1.05f, 0.45f};
    const std::int32_t a = rig.bone("a1" + end, chest, at);
    const Vec3 step = wings ? Vec3{0.5f * side, 0.05f, 0} : Vec3{0.05f * side, -0.15f, 0.08f};
    const std::int32_t b = rig.bone("a2" + end, a, at + step);
    rig.tube({a, b}, at + 2 * step, wings ? 0.05f : 0.03f);
    rig.bridge(a, chest);
    if (wings) {
      const std::int32_t feathers = rig.bone("wing" + end, a, at + Vec3{0.25f * side, 0.02f, -0.1f});
      rig.tube({feathers}, at + Vec3{0.6f * side, 0.02f, -0.5f}, 0.02f);
      rig.bridge(feathers, a);
    }
  }
  return rig.mesh;
}

// A chain of so many bones along +z.
inline SkinnedMesh chain_body(int bones, const std::string& prefix = "s") {
  TubeRig rig;
  std::vector<std::int32_t> chain;
  for (int i = 0; i < bones; ++i)
    chain.push_back(rig.bone(prefix + std::to_string(i), i - 1, {0, 0.1f, 0.2f * float(i)}));
  rig.tube(chain, {0, 0.1f, 0.2f * float(bones)}, 0.1f);
  return rig.mesh;
}

}  // namespace nook::bake
