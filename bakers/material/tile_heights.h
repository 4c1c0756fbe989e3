// Finds the heights of a tile at which its views agree, and intersects rays with heights.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bakers/material/raw_material.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::material {

// Called with the number of finished steps. Return false to stop with Failure(NOOK_ERROR_CANCELLED).
using ReliefProgress = std::function<bool(std::size_t done, std::size_t total)>;

// Returns heights over the plane z = 0 in tiles, one for each texel. At the chosen height, views within 53
// degrees of the normal show the most similar colours in 3 x 3 texels. Tries 49 heights up to 0.24 tiles on
// either side, and interpolates the result between them with a parabola. `progress` counts texels. Any number
// of threads gives the same bits.
std::vector<float> heights_of_views(const RawMaterial& raw, const ReliefProgress& progress = {});

// Heights above the plane z = 0, in tiles. The height of texel (x, y) has the index x * height + y, with
// `height` texels along y. Look-ups are bilinear.
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

// Returns the number of steps for a march over the whole range of heights. A step is at most half a texel
// along the tile.
int steps_of(const HeightMap& map, Vec3 direction, float depth);

// Returns the height at which the ray through (x, y, 0) along `view` first meets the surface. The z of `view`
// must be above 0.
float first_height(const HeightMap& map, HeightRange range, float x, float y, Vec3 view);

}  // namespace nook::bake::material
