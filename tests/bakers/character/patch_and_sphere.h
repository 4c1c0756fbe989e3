// A patch of a surface and a sphere over it, whose AO and occluded directions have closed forms.
#pragma once

#include <cmath>
#include <numbers>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// The mesh is on one bone. A square of `side` x `side` vertices, two millimetres long, lies at the origin and
// faces +z: each of its vertices sees the sphere alike. It comes first; the rest is the sphere.
inline SkinnedMesh patch_and_sphere(Vec3 centre, float radius, int side = 2, int rings = 24) {
  SkinnedMesh mesh;
  mesh.bones.resize(1);
  mesh.bones[0].name = "root";
  const auto add = [&](Vec3 p) {
    mesh.position.push_back(p);
    SkinWeights weights;
    weights.weight[0] = 1;
    mesh.weights.push_back(weights);
    return std::uint32_t(mesh.position.size() - 1);
  };
  constexpr float size = 2e-3f;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      add({size * (float(x) / float(side - 1) - 0.5f), size * (float(y) / float(side - 1) - 0.5f), 0});
  for (int y = 0; y + 1 < side; ++y)
    for (int x = 0; x + 1 < side; ++x) {
      const auto first = std::uint32_t(y * side + x), above = first + std::uint32_t(side);
      mesh.triangle.push_back({first, first + 1, above + 1});
      mesh.triangle.push_back({first, above + 1, above});
    }
  const int segments = 2 * rings;
  const auto start = std::uint32_t(mesh.position.size());
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s < segments; ++s) {
      const float a = std::numbers::pi_v<float> * float(r) / float(rings),
                  b = 2 * std::numbers::pi_v<float> * float(s) / float(segments);
      add(centre + radius * Vec3{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)});
    }
  const auto at = [&](int r, int s) { return start + std::uint32_t(r * segments + s % segments); };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < segments; ++s) {
      mesh.triangle.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
      mesh.triangle.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
    }
  return mesh;
}

// The AO of the patch under a sphere that is wholly above its horizon.
inline float ao_under_sphere(Vec3 centre, float radius, Vec3 normal) {
  return 1 - radius * radius / dot(centre, centre) * dot(normal, normalised(centre));
}

// The mean under cos / pi of the directions inside the cone of such a sphere: the integral of w w^T over a
// cone round d with t = cos(half angle) is pi (2/3 - t + t^3 / 3) across d and 2 pi (1 - t^3) / 3 along it.
inline Vec3 occluded_by_sphere(Vec3 centre, float radius, Vec3 normal) {
  const Vec3 d = normalised(centre);
  const float s = radius / length(centre), t = std::sqrt(1 - s * s), along = dot(normal, d);
  return (2.0f / 3 - t + t * t * t / 3) * (normal - along * d) + (2.0f / 3 * (1 - t * t * t) * along) * d;
}

}  // namespace nook::bake
