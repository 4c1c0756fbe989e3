// A fine sphere of triangles.
#pragma once

#include <cmath>
#include <numbers>

#include "bakers/raytrace/ray_scene.h"

// Its facets lie inside it by less than radius * (pi / segments)^2 / 2.
inline nook::bake::TriangleSoup sphere_soup(nook::Vec3 centre, float radius, int segments) {
  using nook::Vec3;
  nook::bake::TriangleSoup soup;
  for (int i = 0; i <= segments; ++i)
    for (int j = 0; j < 2 * segments; ++j) {
      const float a = std::numbers::pi_v<float> * float(i) / float(segments);
      const float b = std::numbers::pi_v<float> * float(j) / float(segments);
      soup.position.push_back(
          centre + radius * Vec3{std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b)});
    }
  const auto at = [&](int i, int j) { return std::uint32_t(i * 2 * segments + j % (2 * segments)); };
  for (int i = 0; i < segments; ++i)
    for (int j = 0; j < 2 * segments; ++j) {
      soup.triangle.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      soup.triangle.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  return soup;
}
