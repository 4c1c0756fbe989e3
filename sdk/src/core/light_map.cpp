#include "sdk/src/core/light_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdk/src/core/failure.h"

namespace nook {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::uint32_t max_side = 16384;

// The axes of OpenGL's cube maps: s grows along `right`, t along `down`.
struct Face {
  Vec3 forward, right, down;
};
constexpr Face faces[6] = {{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                           {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},   {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                           {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}};

// Returns the solid angle of the rectangle with one corner in the middle of a cube face and the opposite
// corner at (x, y).
double corner_angle(double x, double y) {
  return std::atan2(x * y, std::sqrt(x * x + y * y + 1));
}

}  // namespace

double cube_cell_angle(std::uint32_t column, std::uint32_t row, std::uint32_t side) {
  const double x0 = 2.0 * column / side - 1, x1 = 2.0 * (column + 1) / side - 1;
  const double y0 = 2.0 * row / side - 1, y1 = 2.0 * (row + 1) / side - 1;
  return corner_angle(x1, y1) - corner_angle(x0, y1) - corner_angle(x1, y0) + corner_angle(x0, y0);
}

Vec3 cube_cell_direction(std::uint32_t face, std::uint32_t column, std::uint32_t row, std::uint32_t side) {
  const float x = 2 * (float(column) + 0.5f) / float(side) - 1, y = 2 * (float(row) + 0.5f) / float(side) - 1;
  return normalised(faces[face].forward + faces[face].right * x + faces[face].down * y);
}

std::size_t cube_cell_at(Vec3 d, std::uint32_t side) {
  const float x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  std::uint32_t face = 0;
  if (x >= y && x >= z)
    face = d.x > 0 ? 0 : 1;
  else if (y >= z)
    face = d.y > 0 ? 2 : 3;
  else
    face = d.z > 0 ? 4 : 5;
  const Face& f = faces[face];
  const float depth = std::max(dot(d, f.forward), 1e-30f);
  const auto index = [&](Vec3 axis) {
    const float at = (0.5f * dot(d, axis) / depth + 0.5f) * float(side);
    return std::min(std::uint32_t(std::max(at, 0.0f)), side - 1);
  };
  return (std::size_t(face) * side + index(f.down)) * side + index(f.right);
}

void check_map(const MapView& map) {
  const bool is_cube = map.layout == MapLayout::cube;
  if (map.width < 1 || map.width > max_side || map.height < 1 || map.height > 6 * max_side)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the size of the map is out of range (got %u x %u, need 1 to %u texels along a side)",
                  map.width, map.height, max_side);
  if (is_cube && map.height != 6 * map.width)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "a cube map of width %u needs the height %u for its six faces (got %u)", map.width,
                  6 * map.width, map.height);
  for (std::size_t i = 0; i < map.rgb.size(); ++i)
    if (!(map.rgb[i] >= 0 && map.rgb[i] <= max_map_radiance))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "a texel of the map is out of range (got %g in row %zu, column %zu, need 0 to %g)",
                    double(map.rgb[i]), i / 3 / map.width, i / 3 % map.width, double(max_map_radiance));
}

MapTexel map_texel(const MapView& map, std::uint32_t column, std::uint32_t row) {
  if (map.layout == MapLayout::cube)
    return {cube_cell_direction(row / map.width, column, row % map.width, map.width),
            cube_cell_angle(column, row % map.width, map.width)};
  const double top = std::cos(pi * row / map.height), bottom = std::cos(pi * (row + 1.0) / map.height);
  const double y = 0.5 * (top + bottom), radius = std::sqrt(std::max(0.0, 1 - y * y));
  const double angle = 2 * pi * ((column + 0.5) / map.width - 0.5);
  return {{float(radius * std::cos(angle)), float(y), float(radius * std::sin(angle))},
          2 * pi / map.width * (top - bottom)};
}

}  // namespace nook
