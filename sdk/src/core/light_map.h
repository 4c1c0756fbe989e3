// Maps of distant light in the memory of a host.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"

namespace nook {

// The maximum radiance of a texel. It keeps sums over any map far below the maximum of a float.
inline constexpr float max_map_radiance = 1e15f;

// A map in host memory, 3 floats for each texel.
enum class MapLayout : std::int32_t {
  // Rows run from +y down to -y. The middle column looks along +x, the column a quarter of the width to its
  // right along +z.
  latlong = 0,
  // Six faces of width x width texels, below each other in the order and with the axes of OpenGL.
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

// Treats a cube of side x side cells per face like the texels of a cube map. Returns the unit direction
// through a cell's centre, and its solid angle in steradians.
Vec3 cube_cell_direction(std::uint32_t face, std::uint32_t column, std::uint32_t row, std::uint32_t side);
double cube_cell_angle(std::uint32_t column, std::uint32_t row, std::uint32_t side);
// Returns the number of the cell that holds a direction.
std::size_t cube_cell_at(Vec3 direction, std::uint32_t side);

// The suns of a map are sources so small and bright that a host draws them as separate lights with shadow
// maps. Lobes or probes hold the rest.

// Texels are sun if their luminance is above this many times the mean of the map without its suns.
inline constexpr double sun_ratio = 100;

struct MapSun {
  Vec3 direction;         // unit, towards the centre of its light
  Vec3 irradiance;        // RGB on a surface that faces it, from its light above the limit
  float solid_angle = 0;  // of its texels, steradians
  // The solid angle in steradians that an even disc needs to have the sun's irradiance and the same integral
  // of squared luminance. Texels of glare, which are many but hold little light, hardly count.
  float disc_solid_angle = 0;
};

// Returns the luminance where suns begin: sun_ratio times the mean of everything below it.
double sun_limit(const MapView& map, Memory* memory);

// Returns the part of a texel that belongs to the sky: its colour, at the luminance of the limit or less.
Vec3 without_sun(Vec3 rgb, double limit);

// Removes the brightest suns, up to a number, from `rgb`, a copy of the texels of `map`: their texels keep
// their colour at the luminance of the limit. A sun is a group of touching texels above the limit. Returns
// the removed suns, the brightest first.
Vector<MapSun> take_suns(const MapView& map, Vector<float>& rgb, Memory* memory,
                         std::size_t most = ~std::size_t(0));

}  // namespace nook
