#include "sdk/src/gl/world/frame_casters.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/nnao/pass.h"
#include "sdk/src/gl/world/caster_texels.h"
#include "sdk/src/nnao/host_depth.h"
#include "sdk/src/world/cone.h"
#include "shaders/world/constants.h"

namespace nook::gl {
namespace {

[[noreturn]] void refuse_casters(const Device& device, std::uint32_t casters, std::uint32_t bodies) {
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                "the frame has more casters in view than this OpenGL has room for (got %u casters in %u "
                "bodies, need at most %u of each); leave out bodies that are far from the view",
                casters, bodies, device.max_texels / NOOK_BODY_TEXELS);
}

world::TileGrid grid_of(const WorldFrame& frame, std::uint32_t tile_px) {
  const Viewport viewport = viewport_of(frame.screen);
  world::TileGrid grid;
  grid.width_px = std::uint32_t(viewport.width);
  grid.height_px = std::uint32_t(viewport.height);
  const nnao::ScreenRays rays = nnao::projection_rays(frame.screen.projection, grid.width_px, grid.height_px);
  grid.x_scale = rays.x_scale;
  grid.x_offset = rays.x_offset;
  grid.y_scale = rays.y_scale;
  grid.y_offset = rays.y_offset;
  grid.orthographic = rays.orthographic;
  grid.tile_px = tile_px;
  return grid;
}

// Calls visit for each group that has casters.
template <class Visit>
void each_group(const ReachingGroups& groups, Visit&& visit) {
  for (std::uint32_t g = 0; g < groups.count; ++g) {
    PosedCaster room;
    const ReachingGroup group = groups.group(groups.user, g, room);
    if (!group.casters.empty()) visit(g, group);
  }
}

}  // namespace

float angle_round(const LightCone& cone, float slope) {
  constexpr float widest = 1.56f;
  return std::min(cone.half_angle_radians + 2 * std::atan(slope), widest);
}

void FrameCasters::TileLists::clear() {
  groups.clear();
  ranges.clear();
  texels.clear();
}

void FrameCasters::TileLists::write(const world::TileGrid& grid, std::uint64_t& used) {
  first_tile = static_cast<std::uint32_t>(used);
  if (ranges.empty()) return;
  world::write_tile_lists(grid, ranges, texels);
  used += texels.size() / 4;
}

FrameCasters::FrameCasters(Memory* memory, GLuint unit, ListForm form)
    : table_(memory, unit), form_(form), reaching_(memory), near_(memory), shades_(memory) {}

void FrameCasters::reserve(Device& device, std::uint32_t casters) {
  const std::uint64_t texels = std::uint64_t{casters} * NOOK_CASTER_TEXELS;
  if (texels > device.max_texels)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "desc.casters is too large for this OpenGL (got %u, need at most %llu)", casters,
                  static_cast<unsigned long long>(device.max_texels / NOOK_CASTER_TEXELS));
  table_.reserve(device, GL_RGBA32F, texels, "nook: world casters");
}

std::uint64_t FrameCasters::choose_reaching(const WorldFrame& frame, const world::TileGrid& grid,
                                            const ReachingGroups& groups) {
  std::uint64_t texels = 0;
  each_group(groups, [&](std::uint32_t index, const ReachingGroup& group) {
    const Vec3 centre_vs = viewed(frame.view, group.centre);
    const world::TileRange tiles = world::covered_tiles(grid, centre_vs, group.reach);
    if (tiles.empty) return;
    reaching_.groups.push_back(index);
    reaching_.ranges.push_back(tiles);
    caster_count_ += static_cast<std::uint32_t>(group.casters.size());
    texels += texels_of(group);
    if (!form_.near) return;
    const float merging = group.merging_distance(frame.level_error);
    const bool far = merging < group.reach;
    near_.ranges.push_back(far ? world::covered_tiles(grid, centre_vs, merging) : tiles);
    far_ = far_ || far;
  });
  return texels;
}

std::uint64_t FrameCasters::choose_shades(const WorldFrame& frame, const world::TileGrid& grid,
                                          const ReachingGroups& groups) {
  if (!frame.cone) return 0;
  const LightCone& cone = *frame.cone;
  const float wide = angle_round(cone, world::cone_parts_of(cone.axis, cone.half_angle_radians).slope);
  const world::Shadow shadow{-1.0f * turned(frame.view, cone.axis), std::tan(wide), cone.reach};
  std::uint64_t texels = 0;
  each_group(groups, [&](std::uint32_t index, const ReachingGroup& group) {
    const world::TileRange tiles =
        world::shaded_tiles(grid, viewed(frame.view, group.centre), group.radius, shadow);
    if (tiles.empty) return;
    shades_.groups.push_back(index);
    shades_.ranges.push_back(tiles);
    texels += shade_texels_of(group);
  });
  return texels;
}

void FrameCasters::fit_tiles(const Device& device, world::TileGrid& grid, std::uint64_t texels) {
  const auto most_texels = [&] {
    std::uint64_t sum = texels;
    for (const TileLists* const lists : {&reaching_, &near_, &shades_})
      sum += world::most_list_texels(grid, lists->ranges);
    return sum;
  };
  // Larger tiles make all lists together shorter. In the extreme case, there is a single tile, whose list
  // contains all bodies.
  while (most_texels() > device.max_texels && grid.columns() * grid.rows() > 1) {
    grid.tile_px *= 2;
    for (TileLists* const lists : {&reaching_, &near_, &shades_})
      for (world::TileRange& range : lists->ranges) {
        range.first_column /= 2;
        range.last_column /= 2;
        range.first_row /= 2;
        range.last_row /= 2;
      }
  }
  if (most_texels() > device.max_texels) refuse_casters(device, caster_count_, group_count());
}

std::uint64_t FrameCasters::choose(const Device& device, const WorldFrame& frame,
                                   const ReachingGroups& groups) {
  for (TileLists* const lists : {&reaching_, &near_, &shades_}) lists->clear();
  far_ = false;
  caster_count_ = 0;
  world::TileGrid grid = grid_of(frame, form_.tile_px);
  std::uint64_t texels = choose_reaching(frame, grid, groups);
  first_shade_ = static_cast<std::uint32_t>(texels);
  texels += choose_shades(frame, grid, groups);
  columns_ = light_columns_ = 0;
  if (texels == 0) return 0;
  fit_tiles(device, grid, texels);
  tile_px_ = grid.tile_px;
  if (!reaching_.ranges.empty()) columns_ = grid.columns();
  if (!shades_.ranges.empty()) light_columns_ = grid.columns();
  for (TileLists* const lists : {&reaching_, &near_, &shades_}) lists->write(grid, texels);
  return texels;
}

void FrameCasters::put(const WorldFrame& frame, const ReachingGroups& groups, float* texels) const {
  CasterTexels out(texels, frame.view, group_count());
  for (std::uint32_t body = 0; body < group_count(); ++body) {
    PosedCaster room;
    out.put(body, groups.group(groups.user, reaching_.groups[body], room), frame.level_error);
  }
  out.begin_shades(first_shade_, static_cast<std::uint32_t>(shades_.groups.size()));
  for (std::uint32_t body = 0; body < shades_.groups.size(); ++body) {
    PosedCaster room;
    out.put_shade(body, groups.group(groups.user, shades_.groups[body], room));
  }
  for (const TileLists* const lists : {&reaching_, &near_, &shades_})
    std::copy(lists->texels.begin(), lists->texels.end(), texels + 4 * std::size_t{lists->first_tile});
}

void FrameCasters::write(Device& device, const WorldFrame& frame, const ReachingGroups& groups) {
  const std::uint64_t texels = choose(device, frame, groups);
  if (texels == 0) return;
  table_.write(device, texels, [&](void* memory) { put(frame, groups, static_cast<float*>(memory)); });
}

}  // namespace nook::gl
