// For each tile of the screen, lists the bodies that may darken surfaces in the tile. The lists do not depend
// on the depth of the surfaces. Each body has a sphere. It darkens nothing outside this sphere. The body is
// in the lists of all tiles that its sphere covers on the screen.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"

namespace nook::world {

// A viewport that is divided into tiles of tile_px x tile_px pixels. For a pixel coordinate p, x in view
// space is (x_scale p + x_offset) * depth in a perspective view, and x_scale p + x_offset in an orthographic
// view. y is computed in the same way.
struct TileGrid {
  std::uint32_t width_px = 0, height_px = 0, tile_px = 32;
  float x_scale = 1, x_offset = 0, y_scale = 1, y_offset = 0;
  bool orthographic = false;
  std::uint32_t columns() const;
  std::uint32_t rows() const;
};

// The tiles from the first to the last one, inclusive. An empty range has no tiles.
struct TileRange {
  std::uint32_t first_column = 0, last_column = 0, first_row = 0, last_row = 0;
  bool empty = true;
};

// Returns the tiles that a sphere may cover. All points of the sphere that are in front of the camera are in
// these tiles. `centre` is in view space, metres.
TileRange covered_tiles(const TileGrid& grid, Vec3 centre, float radius);

// The shadow volume of a body in a cone of light. The shadow volume is the union of spheres along a path. The
// centre moves from `centre` along `away`, by up to `reach`. The radius grows by `spread` metres per metre of
// the path. `away` is a unit vector that points away from the light.
struct Shadow {
  Vec3 away;
  float spread = 0, reach = 0;
};
TileRange shaded_tiles(const TileGrid& grid, Vec3 centre, float radius, const Shadow& shadow);

// Returns an upper bound for the number of texels of the lists.
std::uint64_t most_list_texels(const TileGrid& grid, std::span<const TileRange> ranges);

// Writes the texels of the lists. First comes one texel for each tile: (index of the first texel of its
// entries, relative to the first tile's texel; number of entries; 0; 0). Then come the entries, which are
// indices into `ranges`, four in a texel. Resizes `texels`. Throws std::bad_alloc.
void write_tile_lists(const TileGrid& grid, std::span<const TileRange> ranges, Vector<float>& texels);

}  // namespace nook::world
