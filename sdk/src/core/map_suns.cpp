#include "sdk/src/core/light_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace nook {
namespace {

// Returns the luminance with the weights of Rec. 709.
double luminance(Vec3 rgb) {
  return 0.2126 * double(rgb.x) + 0.7152 * double(rgb.y) + 0.0722 * double(rgb.z);
}

// Returns the solid angles of texels: for a latitude-longitude map, of the texels of one column, and for a
// cube map, of the texels of one face. Other columns and faces have the same values.
Vector<double> solid_angles(const MapView& map, Memory* memory) {
  const std::uint32_t columns = map.layout == MapLayout::cube ? map.width : 1,
                      rows = map.layout == MapLayout::cube ? map.width : map.height;
  Vector<double> angles(memory);
  angles.reserve(std::size_t(columns) * rows);
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column)
      angles.push_back(map_texel(map, column, row).solid_angle);
  return angles;
}

double mean_below(const MapView& map, std::span<const double> angles, double limit) {
  const bool is_cube = map.layout == MapLayout::cube;
  double sum = 0;
  for (std::uint32_t row = 0; row < map.height; ++row)
    for (std::uint32_t column = 0; column < map.width; ++column)
      sum += std::min(luminance(map.texel(std::size_t(row) * map.width + column)), limit) *
             angles[is_cube ? std::size_t(row % map.width) * map.width + column : row];
  return sum / (4 * std::numbers::pi);
}

// Adds the neighbours of a texel. The faces of a cube map are treated as separate images, so a sun on an edge
// becomes two suns.
template <class Add>
void neighbours(const MapView& map, std::size_t at, Add&& add) {
  const std::size_t width = map.width, row = at / width, column = at % width;
  const bool is_cube = map.layout == MapLayout::cube;
  const std::size_t top = is_cube ? row / width * width : 0, bottom = is_cube ? top + width : map.height;
  for (std::size_t r = row > top ? row - 1 : row; r < std::min(row + 2, bottom); ++r)
    for (const std::size_t c : {column + width - 1, column + width, column + width + 1}) {
      if (is_cube && (c < width || c >= 2 * width)) continue;
      add(r * width + c % width);
    }
}

constexpr std::uint32_t no_sun = ~0u, in_no_group = no_sun - 1;

struct NumberedSun {
  MapSun sun;
  std::uint32_t number = 0;
};

// Assigns the sun `number` to the texel `first` and to all texels above the limit that are connected to it.
// `stack` is scratch memory.
NumberedSun gather_sun(const MapView& map, double limit, std::size_t first, std::size_t number,
                       Vector<std::uint32_t>& group, Vector<std::size_t>& stack) {
  NumberedSun found{{}, std::uint32_t(number)};
  MapSun& sun = found.sun;
  Vec3 direction;
  double flux = 0, square = 0;
  stack.assign(1, first);
  group[first] = found.number;
  while (!stack.empty()) {
    const std::size_t at = stack.back();
    stack.pop_back();
    const MapTexel texel = map_texel(map, std::uint32_t(at % map.width), std::uint32_t(at / map.width));
    const Vec3 light = map.texel(at) - without_sun(map.texel(at), limit);
    const double bright = luminance(light);
    sun.irradiance += light * float(texel.solid_angle);
    direction += texel.direction * float(bright * texel.solid_angle);
    sun.solid_angle += float(texel.solid_angle);
    flux += bright * texel.solid_angle;
    square += bright * bright * texel.solid_angle;
    neighbours(map, at, [&](std::size_t next) {
      if (group[next] != in_no_group) return;
      group[next] = found.number;
      stack.push_back(next);
    });
  }
  sun.direction = normalised(direction);
  if (square > 0) sun.disc_solid_angle = float(flux * (flux / square));
  return found;
}

}  // namespace

double sun_limit(const MapView& map, Memory* memory) {
  const Vector<double> angles = solid_angles(map, memory);
  // Each iteration lowers the limit and excludes the light above it from the mean. The loop ends when the
  // mean excludes all suns, or when no light is left because all of it belongs to suns.
  double limit = sun_ratio * mean_below(map, angles, std::numeric_limits<double>::infinity());
  for (int round = 0; round < 32; ++round) {
    const double next = sun_ratio * mean_below(map, angles, limit);
    if (next > 0.999 * limit) return next;
    limit = next;
  }
  return limit;
}

Vec3 without_sun(Vec3 rgb, double limit) {
  const double bright = luminance(rgb);
  return bright > limit ? rgb * float(limit / bright) : rgb;
}

Vector<MapSun> take_suns(const MapView& map, Vector<float>& rgb, Memory* memory, std::size_t most) {
  const double limit = sun_limit(map, memory);
  Vector<std::uint32_t> group(map.texel_count(), no_sun, memory);
  for (std::size_t i = 0; i < group.size(); ++i)
    if (luminance(map.texel(i)) > limit) group[i] = in_no_group;
  Vector<NumberedSun> found(memory);
  Vector<std::size_t> stack(memory);
  for (std::size_t first = 0; first < group.size(); ++first)
    if (group[first] == in_no_group)
      found.push_back(gather_sun(map, limit, first, found.size(), group, stack));
  // If the texels of a sun exceed the limit by less than float precision, the sun has no light and no
  // direction, so it is dropped.
  const std::size_t groups = found.size();
  std::erase_if(found, [](const NumberedSun& one) { return !(luminance(one.sun.irradiance) > 0); });
  std::sort(found.begin(), found.end(), [](const NumberedSun& a, const NumberedSun& b) {
    const double first = luminance(a.sun.irradiance), second = luminance(b.sun.irradiance);
    return first != second ? first > second : a.number < b.number;
  });
  Vector<MapSun> suns(memory);
  Vector<std::uint8_t> taken(groups, std::uint8_t(0), memory);
  for (std::size_t i = 0; i < std::min(found.size(), most); ++i) {
    suns.push_back(found[i].sun);
    taken[found[i].number] = 1;
  }
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (group[i] == no_sun || !taken[group[i]]) continue;
    const Vec3 kept = without_sun(map.texel(i), limit);
    rgb[3 * i] = kept.x;
    rgb[3 * i + 1] = kept.y;
    rgb[3 * i + 2] = kept.z;
  }
  return suns;
}

}  // namespace nook
