// Lists the bodies that may reach each tile of the screen. The depth behind a tile does not matter: a body is
// in the list of each tile that the sphere of its reach covers on the screen.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"

namespace nook::world {

// A viewport divided into tiles with sides of tile_px pixels. View space x is (x_scale pixel + x_offset)
// times the depth, or times 1 in an orthographic view; y works the same way.
struct TileGrid {
  std::uint32_t width_px = 0, height_px = 0, tile_px = 32;
  float x_scale = 1, x_offset = 0, y_scale = 1, y_offset = 0;
  bool orthographic = false;
  std::uint32_t columns() const;
  std::uint32_t rows() const;
};

// Tiles from first to last inclusive; none if empty.
struct TileRange {
  std::uint32_t first_column = 0, last_column = 0, first_row = 0, last_row = 0;
  bool empty = true;
};

// Returns the tiles that a sphere may cover. They contain every point of the sphere in front of the camera.
// centre: view space, metres.
TileRange covered_tiles(const TileGrid& grid, Vec3 centre, float radius);

// The shadow of a body in a cone of light. It is made of spheres whose centres move from `centre` by up to
// reach along `away`, and whose radius grows by `spread` metres per metre. `away` is unit and points away
// from the light.
struct Shadow {
  Vec3 away;
  float spread = 0, reach = 0;
};
TileRange shaded_tiles(const TileGrid& grid, Vec3 centre, float radius, const Shadow& shadow);

// Returns a bound of the texels of the lists.
std::uint64_t most_list_texels(const TileGrid& grid, std::span<const TileRange> ranges);

// Writes the texels of the lists: for each tile (first texel of its entries, counted from the first tile's;
// their number; 0; 0), then the entries. Entries are indices into `ranges`, four to a texel. Resizes texels.
// Throws std::bad_alloc.
void write_tile_lists(const TileGrid& grid, std::span<const TileRange> ranges, Vector<float>& texels);

}  // namespace nook::world
