// Writes the casters of a frame to the table that shaders/world/casters.glsl reads. It chooses the groups
// that reach what the view shows and the groups that cast the shadow of a cone into it. For each tile of the
// picture it lists both.
#pragma once

#include <cstdint>

#include "sdk/src/gl/texel_table.h"
#include "sdk/src/gl/world/world_frame.h"
#include "sdk/src/world/tile_lists.h"

namespace nook::gl {

// How a pass makes its lists.
struct ListForm {
  std::uint32_t tile_px = 32;  // minimum number of pixels along a side
  bool near = false;           // adds a second list, of what is nearer than its merging distance
};

class FrameCasters {
 public:
  // unit: the texture unit of the table.
  FrameCasters(Memory* memory, GLuint unit, ListForm form);

  // Makes room for this many casters. Throws Failure.
  void reserve(Device& device, std::uint32_t casters);

  // Chooses the groups of a frame, and writes them and their lists to the table. Throws Failure before
  // anything is written.
  void write(Device& device, const WorldFrame& frame, const ReachingGroups& groups);
  void bind(const Device& device) const { table_.bind(device); }

  const TexelTable& table() const { return table_; }
  std::uint32_t group_count() const { return static_cast<std::uint32_t>(reaching_.groups.size()); }
  std::uint32_t caster_count() const { return caster_count_; }
  // True if a body may be beyond its merging distance.
  bool far() const { return far_; }

  // Where the lists begin in the table, in texels, and how many columns of tiles they have; 0 without a list.
  std::uint32_t tile_px() const { return tile_px_; }
  std::uint32_t columns() const { return columns_; }
  std::uint32_t first_tile() const { return reaching_.first_tile; }
  std::uint32_t first_near_tile() const { return near_.first_tile; }
  std::uint32_t light_columns() const { return light_columns_; }
  std::uint32_t first_light_tile() const { return shades_.first_tile; }
  std::uint32_t first_shade() const { return first_shade_; }

 private:
  // Groups and the tiles they reach.
  struct TileLists {
    explicit TileLists(Memory* memory) : groups(memory), ranges(memory), texels(memory) {}
    void clear();
    // Writes the lists after the first `used` texels of the table, and adds their texels to `used`.
    void write(const world::TileGrid& grid, std::uint64_t& used);

    Vector<std::uint32_t> groups;
    Vector<world::TileRange> ranges;
    Vector<float> texels;
    std::uint32_t first_tile = 0;
  };

  // Each returns the texels of the groups it chose.
  std::uint64_t choose_reaching(const WorldFrame& frame, const world::TileGrid& grid,
                                const ReachingGroups& groups);
  std::uint64_t choose_shades(const WorldFrame& frame, const world::TileGrid& grid,
                              const ReachingGroups& groups);
  // Doubles the size of the tiles until their lists fit the table after `texels`. Throws Failure.
  void fit_tiles(const Device& device, world::TileGrid& grid, std::uint64_t texels);
  // Chooses groups and tiles, and returns the texels of the whole table.
  std::uint64_t choose(const Device& device, const WorldFrame& frame, const ReachingGroups& groups);
  void put(const WorldFrame& frame, const ReachingGroups& groups, float* texels) const;

  TexelTable table_;
  ListForm form_;
  TileLists reaching_, near_, shades_;  // near_ has no groups of its own: it shares reaching_'s
  bool far_ = false;
  std::uint32_t caster_count_ = 0, tile_px_ = 32, columns_ = 0, light_columns_ = 0, first_shade_ = 0;
};

// Returns the half angle, in radians, within which a cone's light counts. Each part of a cone takes a thin
// capsule for a rectangle, whose corners reach beyond its round ends by less than a third of a part. slope:
// of the parts.
float angle_round(const LightCone& cone, float slope);

}  // namespace nook::gl
