// Environment maps of distant light, in host memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"

namespace nook {

// The maximum radiance of a texel. The limit ensures that sums over a map are far below the largest float.
inline constexpr float max_map_radiance = 1e15f;

// The layout of a map in host memory. Each texel has 3 floats.
enum class MapLayout : std::int32_t {
  // The first row is at +y, the last row at -y. The middle column shows the direction +x. The column a
  // quarter of the width to its right shows the direction +z.
  latlong = 0,
  // Six faces of width x width texels, stacked vertically, in the order and with the axes of OpenGL.
  cube = 1,
};
struct MapView {
  MapLayout layout = MapLayout::latlong;
  std::uint32_t width = 0, height = 0;
  std::span<const float> rgb;

  Vec3 texel(std::size_t index) const { return {rgb[3 * index], rgb[3 * index + 1], rgb[3 * index + 2]}; }
  std::size_t texel_count() const { return std::size_t(width) * height; }
};
// Throws Failure(INVALID_ARGUMENT) for a size out of range or a texel outside [0, max_map_radiance].
void check_map(const MapView& map);

struct MapTexel {
  Vec3 direction;  // unit
  double solid_angle = 0;
};
MapTexel map_texel(const MapView& map, std::uint32_t column, std::uint32_t row);

// A cube has side x side cells per face, like the texels of a cube map. This function returns the unit
// direction through a cell's centre, and the cell's solid angle in steradians.
Vec3 cube_cell_direction(std::uint32_t face, std::uint32_t column, std::uint32_t row, std::uint32_t side);
double cube_cell_angle(std::uint32_t column, std::uint32_t row, std::uint32_t side);
// Returns the index of the cell that contains a direction.
std::size_t cube_cell_at(Vec3 direction, std::uint32_t side);

// A sun is a very small and bright light source in a map. Hosts draw suns as separate lights with shadow
// maps. The remaining light is represented by lobes or probes.

// A texel belongs to a sun if its luminance is more than this many times the mean luminance of the map
// without its suns.
inline constexpr double sun_ratio = 100;

struct MapSun {
  Vec3 direction;         // unit vector towards the centre of the sun's light
  Vec3 irradiance;        // RGB irradiance of a surface that faces the sun, from the light that was removed
                          // from the map
  float solid_angle = 0;  // solid angle of the sun's texels, in steradians
  // The solid angle, in steradians, of a uniform disc that has the same irradiance and the same integral of
  // squared luminance as the sun. Glare around a sun can cover many texels, but hardly affects this value,
  // because these texels contain little light.
  float disc_solid_angle = 0;
};

// Returns the luminance above which texels belong to suns. The limit is sun_ratio times the mean luminance of
// all light below this limit.
double sun_limit(const MapView& map, Memory* memory);

// Returns the part of a texel that does not belong to a sun. It has the colour of the texel, but its
// luminance is at most the limit.
Vec3 without_sun(Vec3 rgb, double limit);

// Removes the brightest suns, up to a maximum number, from `rgb`, a copy of the texels of `map`. The
// luminance of the suns' texels is reduced to the limit, and their colour is kept. A sun is a group of
// touching texels above the limit. Returns the removed suns, the brightest first.
Vector<MapSun> take_suns(const MapView& map, Vector<float>& rgb, Memory* memory,
                         std::size_t most = ~std::size_t(0));

}  // namespace nook
