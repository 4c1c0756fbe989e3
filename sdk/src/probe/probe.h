// Probes as plain data: one, or a grid of them that share their functions, with walls between its rooms.
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

// Walls inside the cells of a grid: which of a cell's eight probes count at a place, so that light of one
// room does not reach the next. A cell lies between eight probes; the outermost ones reach beyond them
// without end.

inline constexpr std::size_t wall_planes = NOOK_GRID_PLANES, wall_sides = NOOK_GRID_SIDES;

// A plane in the coordinates of its cell, in spacings from the cell's first probe: a place is behind it where
// dot(normal, place) + offset < 0. Behind the default there is nothing.
struct WallPlane {
  Vec3 normal;
  float offset = 1;
  bool operator==(const WallPlane&) const = default;
};

// Planes cut a cell into sides. Bit k of a side's number is 1 behind plane k, and bit c of its mask is 1 if
// the probe at corner c counts there; x is bit 0 of c, y bit 1 and z bit 2.
struct CellWalls {
  std::array<WallPlane, wall_planes> plane;
  std::array<std::uint8_t, wall_sides> counts{all_corners, all_corners, all_corners, all_corners,
                                              all_corners, all_corners, all_corners, all_corners};

  static constexpr std::uint8_t all_corners = 255;
  // Has no effect on interpolation.
  bool open() const {
    for (const std::uint8_t mask : counts)
      if (mask != all_corners) return false;
    return true;
  }
  bool operator==(const CellWalls&) const = default;
};

std::size_t side_of(const CellWalls& cell, Vec3 in_cell);

// The number that a plane has after it went through half floats, as files and textures hold it.
WallPlane stored(const WallPlane& plane);

struct GridWalls {
  explicit GridWalls(Memory* memory = default_memory()) : cell(memory) {}
  Vector<CellWalls> cell;  // x fastest, then y, z; empty: interpolation ignores walls
  float bias = 0;  // metres along the surface's normal, by which a place is moved before it is looked up

  bool any() const { return !cell.empty(); }
};

inline constexpr std::uint32_t max_probes = 1u << 20;
// No coefficient is larger, so that no sum of an evaluation overflows.
inline constexpr float max_coefficient = 1e22f;

struct Grid {
  std::array<std::uint32_t, 3> counts{1, 1, 1};  // along x, y, z
  Vec3 origin_ws;                                // metres, of the first probe
  Vec3 spacing_ws{1, 1, 1};                      // metres between neighbours

  std::size_t size() const { return std::size_t(counts[0]) * counts[1] * counts[2]; }
  // Of a probe; x fastest, then y, z.
  Vec3 position_ws(std::size_t index) const {
    const auto x = float(index % counts[0]), y = float(index / counts[0] % counts[1]),
               z = float(index / counts[0] / counts[1]);
    return origin_ws + Vec3{x * spacing_ws.x, y * spacing_ws.y, z * spacing_ws.z};
  }
  // Cells lie between probes; an axis with one probe has one.
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

// A place in the cell that holds it.
struct GridPlace {
  std::size_t cell = 0;               // its index
  std::array<std::size_t, 8> corner;  // the probes at its corners; x is bit 0, y bit 1, z bit 2
  Vec3 in_cell;                       // in spacings from corner 0; beyond 0 to 1 outside the grid's probes
};
GridPlace place_in(const Grid& grid, Vec3 position_ws);

// The trilinear weights of the eight corners. Shares along an axis are clamped: from the second argument to 1
// minus that.
std::array<float, 8> corner_weights(Vec3 in_cell, float least);

struct Probes {
  explicit Probes(Memory* memory = default_memory()) : coefficients(memory), recipe(memory), walls(memory) {}

  Basis basis;
  Grid grid;
  Vector<Vec3> coefficients;  // probe by probe (x fastest, then y, z), basis.count of RGB each
  String recipe;              // how they were baked, JSON; may be empty
  GridWalls walls;            // of the grid's cells

  std::span<const Vec3> of(std::size_t index) const {
    return std::span(coefficients).subspan(index * basis.count, basis.count);
  }
};

// Both throw Failure(code): a grid, a basis or a coefficient out of its range.
void check_grid(const Grid& grid, nook_result code);
void check_probes(const Probes& probes, nook_result code);

// The coefficients at a point: trilinear weights between the grid's probes, clamped at its ends.
void interpolate(const Probes& probes, Vec3 position_ws, std::span<Vec3> coefficients);
// The same for a surface with this normal, from the probes that count on its side of the grid's walls.
void interpolate(const Probes& probes, Vec3 position_ws, Vec3 normal, std::span<Vec3> coefficients);

// Gaussians only: function i as a lobe with coefficient i.
void to_lobes(const Basis& basis, std::span<const Vec3> coefficients, std::span<SphericalGaussian> lobes);

}  // namespace nook::probe
