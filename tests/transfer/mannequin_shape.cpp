#include "tests/transfer/mannequin_shape.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "bakers/mannequin/body_mesh.h"

namespace nook::transfer::test {
namespace {

using nook::mannequin::TriangleMesh;

constexpr float tiles_per_metre = 6;

// The axis that is nearest to a direction, 0 to 2, and 3 more where it points backwards.
std::uint32_t nearest_side(glm::dvec3 direction) {
  std::uint32_t axis = 0;
  for (std::uint32_t a = 1; a < 3; ++a)
    if (std::abs(direction[int(a)]) > std::abs(direction[int(axis)])) axis = a;
  return direction[int(axis)] < 0 ? axis + 3 : axis;
}

// u and v from left to right and upwards as a viewer of that side sees them; from above v grows along -z.
std::array<float, 2> coordinates_of(Vec3 p, std::uint32_t side) {
  const float mirror = side < 3 ? 1.0f : -1.0f;
  switch (side % 3) {
    case 0:
      return {-mirror * p.z * tiles_per_metre, p.y * tiles_per_metre};
    case 1:
      return {p.x * tiles_per_metre, -mirror * p.z * tiles_per_metre};
    default:
      return {mirror * p.x * tiles_per_metre, p.y * tiles_per_metre};
  }
}

Vec3 single(glm::dvec3 v) {
  return {float(v.x), float(v.y), float(v.z)};
}

}  // namespace

Shape mannequin_over_plane() {
  const TriangleMesh body = nook::mannequin::make_body_mesh();
  const std::vector<glm::dvec3> normal = area_weighted_normals(body);
  Shape shape;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> made;  // by vertex and side
  float lowest = float(body.positions_m[0].y);
  for (const auto& corners : body.triangles) {
    const glm::dvec3 a = body.positions_m[corners[0]], b = body.positions_m[corners[1]],
                     c = body.positions_m[corners[2]];
    const std::uint32_t side = nearest_side(glm::cross(b - a, c - a));
    std::array<std::uint32_t, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [at, is_new] = made.try_emplace({corners[k], side}, std::uint32_t(shape.position.size()));
      triangle[k] = at->second;
      if (!is_new) continue;
      shape.position.push_back(single(body.positions_m[corners[k]]));
      shape.normal.push_back(normalised(single(normal[corners[k]])));
      shape.uv.push_back(coordinates_of(shape.position.back(), side));
      lowest = std::min(lowest, shape.position.back().y);
    }
    shape.triangle.push_back(triangle);
  }
  append(shape, plane(1.8f, 40, 9, lowest));
  return shape;
}

}  // namespace nook::transfer::test
