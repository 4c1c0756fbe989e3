#include "bakers/nnao/level_set.h"

#include <algorithm>
#include <array>

namespace nook::bake::nnao {
namespace {

struct Corner {
  Vec3 position;
  float distance = 0;
};

// Adds the surface inside a tetrahedron, whose corners are in the order of their bits along the cube's edges:
// neighbouring tetrahedra then compute the same bits for a point on their common edge.
void add_tetrahedron(TriangleSoup& soup, const Mat3x4& frame, const std::array<Corner, 4>& corner) {
  std::array<std::size_t, 4> inside{}, outside{};
  std::size_t inside_count = 0, outside_count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (corner[i].distance < 0)
      inside[inside_count++] = i;
    else
      outside[outside_count++] = i;
  }
  const auto crossing = [&](std::size_t i, std::size_t j) {
    const Corner &a = corner[std::min(i, j)], &b = corner[std::max(i, j)];
    const float t = a.distance / (a.distance - b.distance);
    return transform_point(frame, a.position + t * (b.position - a.position));
  };
  if (inside_count == 1)
    add_triangle(soup, crossing(inside[0], outside[0]), crossing(inside[0], outside[1]),
                 crossing(inside[0], outside[2]));
  if (inside_count == 2)
    add_quad(soup, crossing(inside[0], outside[0]), crossing(inside[0], outside[1]),
             crossing(inside[1], outside[1]), crossing(inside[1], outside[0]));
  if (inside_count == 3)
    add_triangle(soup, crossing(inside[0], outside[0]), crossing(inside[1], outside[0]),
                 crossing(inside[2], outside[0]));
}

}  // namespace

void add_level_set(TriangleSoup& soup, const Mat3x4& frame, Vec3 low, Vec3 high, float cell,
                   const DistanceField& distance) {
  const auto count = [&](float from, float to) { return std::size_t((to - from) / cell) + 2; };
  const std::size_t nx = count(low.x, high.x), ny = count(low.y, high.y), nz = count(low.z, high.z);
  const auto position = [&](std::size_t x, std::size_t y, std::size_t z) {
    return low + cell * Vec3{float(x), float(y), float(z)};
  };
  std::vector<float> value;
  value.reserve(nx * ny * nz);
  for (std::size_t z = 0; z < nz; ++z)
    for (std::size_t y = 0; y < ny; ++y)
      for (std::size_t x = 0; x < nx; ++x) value.push_back(distance(position(x, y, z)));
  constexpr std::size_t paths[6][2] = {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}};
  for (std::size_t z = 0; z + 1 < nz; ++z)
    for (std::size_t y = 0; y + 1 < ny; ++y)
      for (std::size_t x = 0; x + 1 < nx; ++x) {
        std::array<Corner, 8> cube;
        int inside = 0;
        for (std::size_t i = 0; i < 8; ++i) {
          const std::size_t cx = x + (i & 1), cy = y + (i >> 1 & 1), cz = z + (i >> 2);
          cube[i] = {position(cx, cy, cz), value[(cz * ny + cy) * nx + cx]};
          inside += cube[i].distance < 0;
        }
        if (inside == 0 || inside == 8) continue;
        for (const auto& path : paths)
          add_tetrahedron(soup, frame, {cube[0], cube[path[0]], cube[path[1]], cube[7]});
      }
}

}  // namespace nook::bake::nnao
