// The casters of a frame in the table that shaders/world/casters.glsl reads: which groups reach what the view
// shows, which cast the shadow of a cone into it, and for each tile of the picture the lists of both.
#pragma once

#include <cstdint>

#include "sdk/src/gl/texel_table.h"
#include "sdk/src/gl/world/world_frame.h"
#include "sdk/src/world/tile_lists.h"

namespace nook::gl {

// The lists of a pass.
struct ListForm {
  std::uint32_t tile_px = 32;  // along a side, at least
  bool near = false;           // a second list, of what is nearer than its merging distance
};

class FrameCasters {
 public:
  // unit: the texture unit of the table.
  FrameCasters(Memory* memory, GLuint unit, ListForm form);

  // Makes room for so many casters. Throws Failure.
  void reserve(Device& device, std::uint32_t casters);

  // Chooses the groups of a frame, and writes them and their lists to the table. Throws Failure before
  // anything is written.
  void write(Device& device, const WorldFrame& frame, const ReachingGroups& groups);
  void bind(const Device& device) const { table_.bind(device); }

  const TexelTable& table() const { return table_; }
  std::uint32_t group_count() const { return static_cast<std::uint32_t>(reaching_.groups.size()); }
  std::uint32_t caster_count() const { return caster_count_; }
  // A body may be beyond its merging distance.
  bool far() const { return far_; }

  // Where the lists begin in the table, texels, and the columns of their tiles; 0 without a list.
  std::uint32_t tile_px() const { return tile_px_; }
  std::uint32_t columns() const { return columns_; }
  std::uint32_t first_tile() const { return reaching_.first_tile; }
  std::uint32_t first_near_tile() const { return near_.first_tile; }
  std::uint32_t light_columns() const { return light_columns_; }
  std::uint32_t first_light_tile() const { return shades_.first_tile; }
  std::uint32_t first_shade() const { return first_shade_; }

 private:
  // Groups with the tiles that they reach.
  struct TileLists {
    explicit TileLists(Memory* memory) : groups(memory), ranges(memory), texels(memory) {}
    void clear();
    // Writes the lists behind the first `used` texels of the table, and adds theirs.
    void write(const world::TileGrid& grid, std::uint64_t& used);

    Vector<std::uint32_t> groups;
    Vector<world::TileRange> ranges;
    Vector<float> texels;
    std::uint32_t first_tile = 0;
  };

  // Each returns the texels of the groups that it chose.
  std::uint64_t choose_reaching(const WorldFrame& frame, const world::TileGrid& grid,
                                const ReachingGroups& groups);
  std::uint64_t choose_shades(const WorldFrame& frame, const world::TileGrid& grid,
                              const ReachingGroups& groups);
  // Doubles the tiles until their lists fit the table behind `texels`. Throws Failure.
  void fit_tiles(const Device& device, world::TileGrid& grid, std::uint64_t texels);
  // Chooses groups and tiles, and returns the texels of the whole table.
  std::uint64_t choose(const Device& device, const WorldFrame& frame, const ReachingGroups& groups);
  void put(const WorldFrame& frame, const ReachingGroups& groups, float* texels) const;

  TexelTable table_;
  ListForm form_;
  TileLists reaching_, near_, shades_;  // near_ has no groups of its own: its ranges are of those that reach
  bool far_ = false;
  std::uint32_t caster_count_ = 0, tile_px_ = 32, columns_ = 0, light_columns_ = 0, first_shade_ = 0;
};

// The half angle, radians, in which a cone's light counts: each part of a cone takes a capsule as a
// rectangle, whose corners reach beyond its round ends by less than a third of a part. slope: of the parts.
float angle_round(const LightCone& cone, float slope);

}  // namespace nook::gl
