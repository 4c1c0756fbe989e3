#include "bakers/nnao/level_set.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bakers/raytrace/hemisphere.h"

namespace nook::bake::nnao {
namespace {

float lattice(std::uint64_t seed, int x, int y, int z) {
  const auto word = [](int i) { return std::uint64_t(std::uint32_t(i) & 0x1fffffu); };
  return 2 * unit_float(mix_bits(seed ^ mix_bits(word(x) << 42 | word(y) << 21 | word(z)))) - 1;
}

float mixed(float a, float b, float t) {
  return a + (b - a) * t;
}

}  // namespace

float value_noise(std::uint64_t seed, Vec3 p) {
  const Vec3 low{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const auto fade = [](float t) { return t * t * (3 - 2 * t); };
  const float u = fade(p.x - low.x), v = fade(p.y - low.y), w = fade(p.z - low.z);
  const int x = int(low.x), y = int(low.y), z = int(low.z);
  const auto along_x = [&](int j, int k) {
    return mixed(lattice(seed, x, y + j, z + k), lattice(seed, x + 1, y + j, z + k), u);
  };
  return mixed(mixed(along_x(0, 0), along_x(1, 0), v), mixed(along_x(0, 1), along_x(1, 1), v), w);
}

float fractal_noise(std::uint64_t seed, Vec3 p, int octaves) {
  float sum = 0, weight = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += weight * value_noise(seed + std::uint64_t(octave), p);
    weight *= 0.5f;
    p = 2.03f * p;
  }
  return sum;
}

namespace {

struct Corner {
  Vec3 position;
  float distance = 0;
};

// Adds the surface inside a tetrahedron. The corners are sorted by their index in the cube. So neighbouring
// tetrahedra compute bit-identical points on their common edge.
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
