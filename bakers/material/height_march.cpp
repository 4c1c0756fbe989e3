#include "bakers/material/height_march.h"

#include <algorithm>
#include <cmath>

#include "bakers/material/tile_taps.h"

namespace nook::bake::material {

float height_at(const HeightMap& map, float x, float y) {
  return mean_of(taps_at(map.width, map.height, x, y), map.heights.data());
}

HeightRange range_of(const HeightMap& map) {
  const auto [low, high] = std::minmax_element(map.heights.begin(), map.heights.end());
  return {*low, *high};
}

// Steps of a march over the whole range of heights: no more than half a texel along the map.
int steps_of(const HeightMap& map, Vec3 direction, float depth) {
  const float along = depth * std::hypot(direction.x, direction.y) / direction.z;
  return std::clamp(int(2 * along * float(std::max(map.width, map.height))) + 4, 4, 256);
}

float first_height(const HeightMap& map, HeightRange range, float x, float y, Vec3 view) {
  const float depth = range.high - range.low, slope_x = view.x / view.z, slope_y = view.y / view.z;
  const int steps = steps_of(map, view, depth);
  float above_z = range.high,
        above = range.high - height_at(map, x + slope_x * above_z, y + slope_y * above_z);
  for (int i = 1; i <= steps && above > 0; ++i) {
    const float z = range.high - depth * float(i) / float(steps);
    const float over = z - height_at(map, x + slope_x * z, y + slope_y * z);
    if (over <= 0) return above_z + (z - above_z) * above / (above - over);
    above_z = z;
    above = over;
  }
  return above_z;
}

}  // namespace nook::bake::material
