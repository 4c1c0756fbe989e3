// Surfaces whose light and visibility are known in closed form.
#pragma once

#include "bakers/material/meso_surface.h"

namespace nook::bake::material::test {

inline void add_quad(MesoSurface& s, Vec3 a, Vec3 b, Vec3 c, Vec3 d, Vec3 albedo) {
  const auto first = std::uint32_t(s.position.size());
  const Vec3 normal = normalised(cross(b - a, d - a));
  for (const Vec3 p : {a, b, c, d}) {
    s.position.push_back(p);
    s.normal.push_back(normal);
    s.albedo.push_back(albedo);
  }
  s.triangle.push_back({first, first + 1, first + 2});
  s.triangle.push_back({first, first + 2, first + 3});
}

// A flat plate at height z over the whole tile, facing up.
inline MesoSurface flat_plate(float z, Vec3 albedo) {
  MesoSurface s;
  add_quad(s, {0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}, albedo);
  return s;
}

// A ground at height 0, and a strip x0 < x < x1 over all y at height z, facing up.
inline MesoSurface strip_over_ground(float x0, float x1, float z, Vec3 albedo) {
  MesoSurface s = flat_plate(0, albedo);
  add_quad(s, {x0, 0, z}, {x1, 0, z}, {x1, 1, z}, {x0, 1, z}, albedo);
  return s;
}

}  // namespace nook::bake::material::test
