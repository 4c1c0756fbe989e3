#include "bakers/lab/probe/prefiltered_cube.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "bakers/measure/probe/visible_reflections.h"
#include "bakers/raytrace/hemisphere.h"
#include "sdk/src/core/light_map.h"

namespace nook::lab {
namespace {

using measure::ReflectedDirection;
using measure::visible_reflections;

constexpr float least_roughness = 0.1f;
constexpr int steps = 48;  // steps of visible normals per axis

// Returns the direction of texel `place`. The faces are stored below each other.
Vec3 texel_direction(std::size_t place, std::uint32_t size) {
  const auto at = std::uint32_t(place);
  return cube_cell_direction(at / (size * size), at % size, at / size % size, size);
}

}  // namespace

PrefilteredCube::PrefilteredCube(std::uint32_t size, const std::function<Vec3(Vec3)>& light) {
  const int count = std::bit_width(size);
  for (int i = 0; i < count; ++i) {
    const double share = count > 1 ? double(i) / (count - 1) : 0;
    const double roughness = double(least_roughness) + (1 - double(least_roughness)) * share;
    const double alpha = roughness * roughness;
    const std::vector<ReflectedDirection> lobe = visible_reflections(alpha, alpha, 0, 0, 1, steps);
    const std::uint32_t side = size >> i;
    Level level{side, std::vector<Vec3>(6 * std::size_t(side) * side)};
    tbb::parallel_for(std::size_t(0), level.texels.size(), [&](std::size_t t) {
      const bake::Frame frame = bake::turned_frame(texel_direction(t, side), 1, 0);
      Vec3 sum;
      float whole = 0;
      for (const ReflectedDirection& l : lobe) {
        const auto weight = float(l.weight);
        sum += light(bake::to_world(frame, {float(l.x), float(l.y), float(l.z)})) * weight;
        whole += weight;
      }
      level.texels[t] = sum * (1 / whole);
    });
    levels_.push_back(std::move(level));
  }
}

// Interpolates the four texels around the direction. At a face edge, texel centres may lie half a texel
// outside the face.
Vec3 PrefilteredCube::at(const Level& level, Vec3 direction) {
  const Vec3 size{std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)};
  const float largest = std::max({size.x, size.y, size.z});
  const bool x = size.x == largest, y = !x && size.y == largest;
  const Vec3 d = direction * (1 / largest);
  const float side = float(level.size), u = 0.5f * side * ((x ? d.y : d.x) + 1) - 0.5f,
              v = 0.5f * side * ((x || y ? d.z : d.y) + 1) - 0.5f;
  const float left = std::floor(u), top = std::floor(v);
  Vec3 sum;
  for (int corner = 0; corner < 4; ++corner) {
    const float column = left + float(corner & 1), row = top + float(corner >> 1);
    const float a = 2 * (column + 0.5f) / side - 1, b = 2 * (row + 0.5f) / side - 1;
    const Vec3 centre = x ? Vec3{d.x, a, b} : y ? Vec3{a, d.y, b} : Vec3{a, b, d.z};
    const float share = (1 - std::abs(u - column)) * (1 - std::abs(v - row));
    sum += level.texels[cube_cell_at(normalised(centre), level.size)] * share;
  }
  return sum;
}

Vec3 PrefilteredCube::reflected(const probe::Surface& surface) const {
  const float alpha = std::sqrt(surface.alpha_x * surface.alpha_y), roughness = std::sqrt(alpha);
  const Vec3 mirrored = surface.normal * (2 * dot(surface.normal, surface.view)) - surface.view;
  // The dominant direction lies between the mirror direction and the normal. The rougher the surface, the
  // closer it is to the normal.
  const float towards = (1 - alpha) * (std::sqrt(1 - alpha) + alpha);
  const Vec3 direction = normalised(surface.normal * (1 - towards) + mirrored * towards);
  const float last = float(levels_.size() - 1);
  const float place = std::clamp((roughness - least_roughness) / (1 - least_roughness), 0.0f, 1.0f) * last;
  const auto low = std::size_t(std::min(std::floor(place), std::max(last - 1, 0.0f)));
  const std::size_t high = std::min(low + 1, levels_.size() - 1);
  const float share = place - float(low);
  return at(levels_[low], direction) * (1 - share) + at(levels_[high], direction) * share;
}

std::size_t PrefilteredCube::bytes() const {
  std::size_t texels = 0;
  for (const Level& level : levels_) texels += level.texels.size();
  return 4 * texels;
}

}  // namespace nook::lab
