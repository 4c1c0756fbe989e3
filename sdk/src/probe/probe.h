// Stores probes as plain data: a single probe, or a grid of probes with the same basis. A grid can have walls
// between rooms.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/probe/basis.h"
#include "shaders/probe/constants.h"

namespace nook::probe {

// A cell of the grid lies between eight probes; the outermost cells extend to infinity. Walls inside a cell
// determine which of its eight probes are used at a place, so that the light of one room does not leak into
// the next.

inline constexpr std::size_t wall_planes = NOOK_GRID_PLANES, wall_sides = NOOK_GRID_SIDES;

// A plane in the coordinates of its cell. The cell's first probe is at 0, and the unit is the grid's spacing.
// A place is behind the plane if dot(normal, place) + offset < 0. No place is behind the default plane.
struct WallPlane {
  Vec3 normal;
  float offset = 1;
  bool operator==(const WallPlane&) const = default;
};

// The planes cut a cell into sides. Bit k of a side's index is 1 if the side is behind plane k. Each side has
// a mask in `counts`: bit c is 1 if the probe at corner c is used on that side. In the index c, x is bit 0, y
// is bit 1 and z is bit 2.
struct CellWalls {
  std::array<WallPlane, wall_planes> plane;
  std::array<std::uint8_t, wall_sides> counts{all_corners, all_corners, all_corners, all_corners,
                                              all_corners, all_corners, all_corners, all_corners};

  static constexpr std::uint8_t all_corners = 255;
  // Returns true if the cell has no walls that change the interpolation.
  bool open() const {
    for (const std::uint8_t mask : counts)
      if (mask != all_corners) return false;
    return true;
  }
  bool operator==(const CellWalls&) const = default;
};

std::size_t side_of(const CellWalls& cell, Vec3 in_cell);

// Returns a plane rounded to half floats, as files and textures store it.
WallPlane stored(const WallPlane& plane);

struct GridWalls {
  explicit GridWalls(Memory* memory = default_memory()) : cell(memory) {}
  Vector<CellWalls> cell;  // x fastest, then y, z; empty: interpolation ignores walls
  float bias = 0;          // metres; a point is moved by this distance along the surface's normal before the
                           // lookup

  bool any() const { return !cell.empty(); }
};

inline constexpr std::uint32_t max_probes = 1u << 20;
// The maximum magnitude of a coefficient. With this limit, the sums of an evaluation do not overflow.
inline constexpr float max_coefficient = 1e22f;

struct Grid {
  std::array<std::uint32_t, 3> counts{1, 1, 1};  // along x, y, z
  Vec3 origin_ws;                                // metres, of the first probe
  Vec3 spacing_ws{1, 1, 1};                      // metres between neighbours

  std::size_t size() const { return std::size_t(counts[0]) * counts[1] * counts[2]; }
  // Returns the position of a probe. In the index, x varies fastest, then y, then z.
  Vec3 position_ws(std::size_t index) const {
    const auto x = float(index % counts[0]), y = float(index / counts[0] % counts[1]),
               z = float(index / counts[0] / counts[1]);
    return origin_ws + Vec3{x * spacing_ws.x, y * spacing_ws.y, z * spacing_ws.z};
  }
  // Returns the number of cells along each axis. Cells lie between probes, but an axis with a single probe
  // has one cell.
  std::array<std::uint32_t, 3> cell_counts() const {
    return {counts[0] > 1 ? counts[0] - 1 : 1, counts[1] > 1 ? counts[1] - 1 : 1,
            counts[2] > 1 ? counts[2] - 1 : 1};
  }
  std::size_t cells() const {
    const auto [x, y, z] = cell_counts();
    return std::size_t(x) * y * z;
  }
  bool operator==(const Grid&) const = default;
};

// A place in the grid: the cell that contains it, and the position in the cell.
struct GridPlace {
  std::size_t cell = 0;               // index of the cell
  std::array<std::size_t, 8> corner;  // the probes at the cell's corners; x is bit 0, y bit 1, z bit 2
  Vec3 in_cell;                       // in spacings from corner 0; below 0 or above 1 outside the grid
};
GridPlace place_in(const Grid& grid, Vec3 position_ws);

// Returns the trilinear weights of the eight corners. Before this, the interpolation factor of each axis is
// clamped to [least, 1 - least].
std::array<float, 8> corner_weights(Vec3 in_cell, float least);

struct Probes {
  explicit Probes(Memory* memory = default_memory())
      : coefficients(memory), gloss(memory), recipe(memory), walls(memory) {}

  Basis basis;
  Grid grid;
  Vector<Vec3> coefficients;  // probe by probe (x fastest, then y, then z); basis.count RGB values for each
                              // probe
  Vector<Vec3> gloss;         // only for Gaussians: non-negative amplitudes for glossy reflection (gloss.h),
                              // in the same order; if empty, glossy reflection uses `coefficients`
  String recipe;              // settings of the bake, JSON; may be empty
  GridWalls walls;            // walls in the cells of the grid

  std::span<const Vec3> of(std::size_t index) const {
    return std::span(coefficients).subspan(index * basis.count, basis.count);
  }
  bool has_gloss() const { return !gloss.empty(); }
};

// Both functions throw Failure(code) if a value of the grid, the basis or the coefficients is out of range.
void check_grid(const Grid& grid, nook_result code);
void check_probes(const Probes& probes, nook_result code);

// Interpolates the coefficients at a point, trilinearly between the probes. Points outside the grid are
// clamped to it.
void interpolate(const Probes& probes, Vec3 position_ws, std::span<Vec3> coefficients);
// Interpolates the amplitudes for glossy reflection in the same way. The probes must have them.
void interpolate_gloss(const Probes& probes, Vec3 position_ws, std::span<Vec3> amplitudes);
// Interpolates the coefficients for a point of a surface with this normal. Walls divide the cell into sides.
// Only the probes that the walls allow on the side of the point are used.
void interpolate(const Probes& probes, Vec3 position_ws, Vec3 normal, std::span<Vec3> coefficients);

// Only for Gaussians. Lobe i gets the axis and sharpness of function i, and coefficient i as its amplitude.
void to_lobes(const Basis& basis, std::span<const Vec3> coefficients, std::span<SphericalGaussian> lobes);

}  // namespace nook::probe
