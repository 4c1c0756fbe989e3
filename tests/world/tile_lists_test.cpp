#include "sdk/src/world/tile_lists.h"

#include <algorithm>
#include <cmath>

#include "tests/catch.h"
#include "tests/character/model_sample.h"

using namespace nook;
using namespace nook::test;

namespace {

world::TileGrid grid_of(bool orthographic) {
  world::TileGrid grid;
  grid.width_px = 200;
  grid.height_px = 130;
  grid.x_scale = 2.0f / 200;
  grid.x_offset = -0.9f;  // off-centre
  grid.y_scale = 1.3f / 130;
  grid.y_offset = -0.6f;
  grid.orthographic = orthographic;
  return grid;
}

// The tile of the pixel that shows a point; false outside the viewport.
bool tile_of(const world::TileGrid& grid, Vec3 p, std::uint32_t& column, std::uint32_t& row) {
  const float extent = grid.orthographic ? 1 : -p.z;
  const float x = (p.x / extent - grid.x_offset) / grid.x_scale,
              y = (p.y / extent - grid.y_offset) / grid.y_scale;
  if (!(extent > 0 && x >= 0 && y >= 0 && x < float(grid.width_px) && y < float(grid.height_px)))
    return false;
  column = std::uint32_t(x) / grid.tile_px;
  row = std::uint32_t(y) / grid.tile_px;
  return true;
}

}  // namespace

TEST_CASE("tile lists: every point of a sphere that is seen lies in its tiles") {
  Numbers numbers(7);
  for (const bool orthographic : {false, true}) {
    const world::TileGrid grid = grid_of(orthographic);
    int seen = 0, empty = 0;
    for (int i = 0; i < 400; ++i) {
      const Vec3 centre{numbers.between(-4, 4), numbers.between(-4, 4), numbers.between(-6, 2)};
      const float radius = numbers.between(0.05f, 1.5f);
      const world::TileRange range = world::covered_tiles(grid, centre, radius);
      empty += range.empty;
      for (int k = 0; k < 50; ++k) {
        std::uint32_t column = 0, row = 0;
        if (!tile_of(grid, centre + radius * numbers.direction(), column, row)) continue;
        ++seen;
        REQUIRE_FALSE(range.empty);
        REQUIRE((range.first_column <= column && column <= range.last_column));
        REQUIRE((range.first_row <= row && row <= range.last_row));
      }
    }
    CHECK(seen > 500);
    CHECK(empty > 50);
  }
}

TEST_CASE("tile lists: every point of a shadow that is seen lies in its tiles") {
  Numbers numbers(9);
  for (const bool orthographic : {false, true}) {
    const world::TileGrid grid = grid_of(orthographic);
    int seen = 0, empty = 0;
    for (int i = 0; i < 400; ++i) {
      const Vec3 centre{numbers.between(-6, 6), numbers.between(-6, 6), numbers.between(-8, 3)};
      const float radius = numbers.between(0.05f, 1.0f);
      const world::Shadow shadow{numbers.direction(), numbers.between(0.01f, 0.5f), numbers.between(1, 20)};
      const world::TileRange range = world::shaded_tiles(grid, centre, radius, shadow);
      empty += range.empty;
      for (int k = 0; k < 50; ++k) {
        const float along = numbers.between(0, shadow.reach);
        const Vec3 p = centre + along * shadow.away + (radius + shadow.spread * along) * numbers.direction();
        std::uint32_t column = 0, row = 0;
        if (!tile_of(grid, p, column, row)) continue;
        ++seen;
        REQUIRE_FALSE(range.empty);
        REQUIRE((range.first_column <= column && column <= range.last_column));
        REQUIRE((range.first_row <= row && row <= range.last_row));
      }
    }
    CHECK(seen > 200);
    CHECK(empty > 20);
  }
}

TEST_CASE("tile lists: a tile lists the ranges that hold it, in their order") {
  const world::TileGrid grid = grid_of(false);
  REQUIRE((grid.columns() == 7 && grid.rows() == 5));
  Numbers numbers(3);
  std::vector<world::TileRange> ranges;
  for (int i = 0; i < 30; ++i) {
    world::TileRange range;
    range.first_column = std::uint32_t(numbers.between(0, 6.9f));
    range.last_column = std::min(range.first_column + 2, 6u);
    range.first_row = std::uint32_t(numbers.between(0, 4.9f));
    range.last_row = std::min(range.first_row + 1, 4u);
    range.empty = i % 7 == 0;
    ranges.push_back(range);
  }
  Vector<float> texels(default_memory());
  world::write_tile_lists(grid, ranges, texels);
  CHECK(texels.size() / 4 <= world::most_list_texels(grid, ranges));
  for (std::uint32_t tile = 0; tile < 35; ++tile) {
    std::vector<float> wanted;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const world::TileRange& r = ranges[i];
      if (!r.empty && r.first_column <= tile % 7 && tile % 7 <= r.last_column && r.first_row <= tile / 7 &&
          tile / 7 <= r.last_row)
        wanted.push_back(float(i));
    }
    const auto first = std::size_t(texels[4 * tile]), count = std::size_t(texels[4 * tile + 1]);
    REQUIRE(count == wanted.size());
    REQUIRE(4 * first + count <= texels.size());
    for (std::size_t i = 0; i < count; ++i) REQUIRE(texels[4 * first + i] == wanted[i]);
  }
}

TEST_CASE(
    "tile lists: a sphere at the camera, an endless one and one that is not a number cover everything") {
  const world::TileGrid grid = grid_of(false);
  for (const auto& [centre, radius] : {std::pair{Vec3{0, 0, 0}, 1.0f},
                                       {Vec3{0, 0, 0.5f}, 1.0f},
                                       {Vec3{3, 0, -2}, 1e15f},
                                       {Vec3{0, 0, NAN}, 1.0f}}) {
    const world::TileRange range = world::covered_tiles(grid, centre, radius);
    CHECK_FALSE(range.empty);
    CHECK((range.first_column == 0 && range.last_column == 6));
    CHECK((range.first_row == 0 && range.last_row == 4));
  }
}
