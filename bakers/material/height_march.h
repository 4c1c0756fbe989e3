// Rays that meet the heights of a tile, which repeats.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/vec.h"

namespace nook::bake::material {

// Heights over the plane z = 0 in tiles, texel x * height + y, read linearly.
struct HeightMap {
  std::uint32_t width = 0, height = 0;
  std::span<const float> heights;
};

struct HeightRange {
  float low = 0, high = 0;
};
HeightRange range_of(const HeightMap& map);

// x and y are in tiles.
float height_at(const HeightMap& map, float x, float y);

// Steps of a march over the whole range of heights: no more than half a texel along the tile.
int steps_of(const HeightMap& map, Vec3 direction, float depth);

// Where the ray through (x, y, 0) along a view, whose z is above 0, first meets the heights: its height.
float first_height(const HeightMap& map, HeightRange range, float x, float y, Vec3 view);

}  // namespace nook::bake::material
