// Writes the occluders (casters) of a frame to the table that shaders/world/casters.glsl reads. It selects
// the groups that can darken visible surfaces, and the groups that cast shadows from a light cone into the
// view. For each tile of the picture, it writes a list of both kinds.
#pragma once

#include <cstdint>

#include "sdk/src/gl/texel_table.h"
#include "sdk/src/gl/world/world_frame.h"
#include "sdk/src/world/tile_lists.h"

namespace nook::gl {

// Settings for the lists of a pass.
struct ListForm {
  std::uint32_t tile_px = 32;  // minimum size of a tile along a side, in pixels
  bool near = false;           // adds a list of the bodies that are nearer to the camera than their merging
                               // distance
};

class FrameCasters {
 public:
  // `unit` is the texture unit of the table.
  FrameCasters(Memory* memory, GLuint unit, ListForm form);

  // Reserves memory for this many casters. Throws Failure.
  void reserve(Device& device, std::uint32_t casters);

  // Selects the groups of a frame, and writes the groups and their lists to the table. If it throws Failure,
  // nothing has been written.
  void write(Device& device, const WorldFrame& frame, const ReachingGroups& groups);
  void bind(const Device& device) const { table_.bind(device); }

  const TexelTable& table() const { return table_; }
  std::uint32_t group_count() const { return static_cast<std::uint32_t>(reaching_.groups.size()); }
  std::uint32_t caster_count() const { return caster_count_; }
  // Returns true if some body may be farther away than its merging distance.
  bool far() const { return far_; }

  // The functions below describe the lists in the table: the size of a tile in pixels, the numbers of tile
  // columns, and the position of each list in texels. A value is 0 if its list does not exist.
  std::uint32_t tile_px() const { return tile_px_; }
  std::uint32_t columns() const { return columns_; }
  std::uint32_t first_tile() const { return reaching_.first_tile; }
  std::uint32_t first_near_tile() const { return near_.first_tile; }
  std::uint32_t light_columns() const { return light_columns_; }
  std::uint32_t first_light_tile() const { return shades_.first_tile; }
  std::uint32_t first_shade() const { return first_shade_; }

 private:
  // A selection of groups, and the tiles that each group reaches.
  struct TileLists {
    explicit TileLists(Memory* memory) : groups(memory), ranges(memory), texels(memory) {}
    void clear();
    // Writes the lists to the table, after the first `used` texels, and increases `used` by their number of
    // texels.
    void write(const world::TileGrid& grid, std::uint64_t& used);

    Vector<std::uint32_t> groups;
    Vector<world::TileRange> ranges;
    Vector<float> texels;
    std::uint32_t first_tile = 0;
  };

  // Both functions select groups, and return the number of texels that these groups take.
  std::uint64_t choose_reaching(const WorldFrame& frame, const world::TileGrid& grid,
                                const ReachingGroups& groups);
  std::uint64_t choose_shades(const WorldFrame& frame, const world::TileGrid& grid,
                              const ReachingGroups& groups);
  // Doubles the size of the tiles until the lists fit into the table after the first `texels` texels. Throws
  // Failure.
  void fit_tiles(const Device& device, world::TileGrid& grid, std::uint64_t texels);
  // Selects groups and tiles, and returns the number of texels of the whole table.
  std::uint64_t choose(const Device& device, const WorldFrame& frame, const ReachingGroups& groups);
  void put(const WorldFrame& frame, const ReachingGroups& groups, float* texels) const;

  TexelTable table_;
  ListForm form_;
  TileLists reaching_, near_, shades_;  // near_ refers to the groups of reaching_
  bool far_ = false;
  std::uint32_t caster_count_ = 0, tile_px_ = 32, columns_ = 0, light_columns_ = 0, first_shade_ = 0;
};

// Returns the half angle, in radians, of the region around a light cone in which occluders can affect the
// cone's light. It is larger than the cone, because each part of the cone replaces a thin capsule by a
// rectangle. The corners of this rectangle extend beyond the capsule's round ends by less than a third of a
// part. `slope` is the slope of the parts.
float angle_round(const LightCone& cone, float slope);

}  // namespace nook::gl
