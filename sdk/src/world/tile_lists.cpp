#include "sdk/src/world/tile_lists.h"

#include <algorithm>
#include <cmath>

namespace nook::world {
namespace {

constexpr std::uint32_t tiles_along(std::uint32_t length_px, std::uint32_t tile_px) {
  return (length_px + tile_px - 1) / tile_px;
}

// The extent of a sphere along one screen axis. The sphere appears between two angles from the camera's axis;
// their tangents are stored. On a side where the sphere reaches beside or behind the camera, the extent is
// infinite.
struct Extent {
  float low = -INFINITY, high = INFINITY;
};

Extent perspective_extent(float aside, float depth, float radius) {
  const float distance2 = aside * aside + depth * depth;
  if (!(distance2 > radius * radius)) return {};
  const float middle = std::atan2(aside, depth), half = std::asin(radius / std::sqrt(distance2));
  constexpr float ahead = 1.56f;  // radians, just less than a right angle
  return {middle - half > -ahead ? std::tan(middle - half) : -INFINITY,
          middle + half < ahead ? std::tan(middle + half) : INFINITY};
}

// Finds the tiles that overlap the extent. Returns false if no pixel from 0 to size_px is in the extent.
bool tiles_between(Extent extent, float scale, float offset, std::uint32_t size_px, std::uint32_t tile_px,
                   std::uint32_t& first, std::uint32_t& last) {
  float low = (extent.low - offset) / scale, high = (extent.high - offset) / scale;
  if (low > high) std::swap(low, high);
  // If a value is NaN, the result is true.
  if (!(high >= 0 && low <= float(size_px))) return std::isnan(low) || std::isnan(high);
  const auto tile = [&](float pixel) {
    return std::uint32_t(std::clamp(pixel, 0.0f, float(size_px - 1))) / tile_px;
  };
  first = tile(low);
  last = tile(high);
  return true;
}

}  // namespace

std::uint32_t TileGrid::columns() const {
  return tiles_along(width_px, tile_px);
}

std::uint32_t TileGrid::rows() const {
  return tiles_along(height_px, tile_px);
}

TileRange covered_tiles(const TileGrid& grid, Vec3 centre, float radius) {
  TileRange range{0, grid.columns() - 1, 0, grid.rows() - 1, false};
  const float depth = -centre.z;
  Extent x{centre.x - radius, centre.x + radius}, y{centre.y - radius, centre.y + radius};
  if (!grid.orthographic) {
    if (depth + radius <= 0) return {};
    x = perspective_extent(centre.x, depth, radius);
    y = perspective_extent(centre.y, depth, radius);
  }
  range.empty = !tiles_between(x, grid.x_scale, grid.x_offset, grid.width_px, grid.tile_px,
                               range.first_column, range.last_column) ||
                !tiles_between(y, grid.y_scale, grid.y_offset, grid.height_px, grid.tile_px, range.first_row,
                               range.last_row);
  return range;
}

TileRange shaded_tiles(const TileGrid& grid, Vec3 centre, float radius, const Shadow& shadow) {
  // Divides the length of the shadow into steps, and bounds each part of the shadow by a sphere. The steps
  // are so short that the diameter of the sphere is not much larger than the width of the shadow. The last
  // step covers the remaining length.
  constexpr int most_steps = 12;
  TileRange all;
  float from = 0;
  for (int step = 0; step < most_steps && from < shadow.reach; ++step) {
    const float widest = radius + shadow.spread * from;
    const float to = step + 1 < most_steps ? std::min(from + 3 * widest, shadow.reach) : shadow.reach;
    const TileRange tiles = covered_tiles(grid, centre + 0.5f * (from + to) * shadow.away,
                                          0.5f * (to - from) + radius + shadow.spread * to);
    from = to;
    if (tiles.empty) continue;
    if (all.empty) {
      all = tiles;
      continue;
    }
    all.first_column = std::min(all.first_column, tiles.first_column);
    all.last_column = std::max(all.last_column, tiles.last_column);
    all.first_row = std::min(all.first_row, tiles.first_row);
    all.last_row = std::max(all.last_row, tiles.last_row);
  }
  return all;
}

std::uint64_t most_list_texels(const TileGrid& grid, std::span<const TileRange> ranges) {
  std::uint64_t entries = 0;
  for (const TileRange& r : ranges)
    if (!r.empty)
      entries += std::uint64_t{r.last_column - r.first_column + 1} * (r.last_row - r.first_row + 1);
  // Each tile has one texel that describes its list, and at most one texel of entries that is not full.
  return 2 * std::uint64_t{grid.columns()} * grid.rows() + entries / 4;
}

void write_tile_lists(const TileGrid& grid, std::span<const TileRange> ranges, Vector<float>& texels) {
  const std::uint32_t columns = grid.columns(), tiles = columns * grid.rows();
  texels.assign(std::size_t{tiles} * 4, 0.0f);
  const auto each_tile = [&](const TileRange& range, const auto& visit) {
    if (range.empty) return;
    for (std::uint32_t row = range.first_row; row <= range.last_row; ++row)
      for (std::uint32_t column = range.first_column; column <= range.last_column; ++column)
        visit(std::size_t{row} * columns + column);
  };
  for (const TileRange& range : ranges)
    each_tile(range, [&](std::size_t tile) { texels[4 * tile + 1] += 1; });
  std::size_t next = tiles;
  for (std::uint32_t tile = 0; tile < tiles; ++tile) {
    texels[4 * std::size_t{tile}] = float(next);
    next += (std::size_t(texels[4 * std::size_t{tile} + 1]) + 3) / 4;
    texels[4 * std::size_t{tile} + 1] = 0;
  }
  texels.resize(next * 4, 0.0f);
  for (std::size_t i = 0; i < ranges.size(); ++i)
    each_tile(ranges[i], [&](std::size_t tile) {
      float& count = texels[4 * tile + 1];
      texels[4 * std::size_t(texels[4 * tile]) + std::size_t(count)] = float(i);
      count += 1;
    });
}

}  // namespace nook::world
