// Probes as plain data: one, or a grid that shares its functions, with walls between its rooms.
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

// Walls inside the cells of a grid decide which of a cell's eight probes count at a place, so that light of
// one room does not reach the next. A cell lies between eight probes; the outermost cells extend without end.

inline constexpr std::size_t wall_planes = NOOK_GRID_PLANES, wall_sides = NOOK_GRID_SIDES;

// A plane uses the coordinates of its cell, in spacings from the cell's first probe. A place is behind it if
// dot(normal, place) + offset < 0. Nothing is behind the default plane.
struct WallPlane {
  Vec3 normal;
  float offset = 1;
  bool operator==(const WallPlane&) const = default;
};

// Planes cut a cell into sides. Bit k of a side's number is 1 behind plane k. Bit c of its mask is 1 if the
// probe at corner c counts there; x is bit 0 of c, y bit 1 and z bit 2.
struct CellWalls {
  std::array<WallPlane, wall_planes> plane;
  std::array<std::uint8_t, wall_sides> counts{all_corners, all_corners, all_corners, all_corners,
                                              all_corners, all_corners, all_corners, all_corners};

  static constexpr std::uint8_t all_corners = 255;
  // True if it has no effect on interpolation.
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
  float bias = 0;          // metres along the surface's normal by which a place moves before lookup

  bool any() const { return !cell.empty(); }
};

inline constexpr std::uint32_t max_probes = 1u << 20;
// The maximum coefficient, so that no sum of an evaluation overflows.
inline constexpr float max_coefficient = 1e22f;

struct Grid {
  std::array<std::uint32_t, 3> counts{1, 1, 1};  // along x, y, z
  Vec3 origin_ws;                                // metres, of the first probe
  Vec3 spacing_ws{1, 1, 1};                      // metres between neighbours

  std::size_t size() const { return std::size_t(counts[0]) * counts[1] * counts[2]; }
  // Position of a probe; x fastest, then y, z.
  Vec3 position_ws(std::size_t index) const {
    const auto x = float(index % counts[0]), y = float(index / counts[0] % counts[1]),
               z = float(index / counts[0] / counts[1]);
    return origin_ws + Vec3{x * spacing_ws.x, y * spacing_ws.y, z * spacing_ws.z};
  }
  // Cells lie between probes; an axis with one probe has one cell.
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

// A place, and the cell that contains it.
struct GridPlace {
  std::size_t cell = 0;               // its index
  std::array<std::size_t, 8> corner;  // the probes at its corners; x is bit 0, y bit 1, z bit 2
  Vec3 in_cell;                       // in spacings from corner 0; outside the grid's probes beyond 0 to 1
};
GridPlace place_in(const Grid& grid, Vec3 position_ws);

// Returns the trilinear weights of the eight corners. Shares along an axis are clamped to [least, 1 - least].
std::array<float, 8> corner_weights(Vec3 in_cell, float least);

struct Probes {
  explicit Probes(Memory* memory = default_memory())
      : coefficients(memory), gloss(memory), recipe(memory), walls(memory) {}

  Basis basis;
  Grid grid;
  Vector<Vec3> coefficients;  // probe by probe (x fastest, then y, z), basis.count of RGB each
  Vector<Vec3> gloss;         // Gaussians: amplitudes for glossy reflection, none negative, see gloss.h, in
                              // the order of coefficients; empty: glossy reflection reads coefficients
  String recipe;              // how they were baked, JSON; may be empty
  GridWalls walls;            // of the grid's cells

  std::span<const Vec3> of(std::size_t index) const {
    return std::span(coefficients).subspan(index * basis.count, basis.count);
  }
  bool has_gloss() const { return !gloss.empty(); }
};

// Both throw Failure(code) if a grid, a basis or a coefficient is out of range.
void check_grid(const Grid& grid, nook_result code);
void check_probes(const Probes& probes, nook_result code);

// Interpolates the coefficients at a point: trilinear between the grid's probes, clamped at its ends.
void interpolate(const Probes& probes, Vec3 position_ws, std::span<Vec3> coefficients);
// Interpolates the amplitudes of gloss, which the probes must have, in the same way.
void interpolate_gloss(const Probes& probes, Vec3 position_ws, std::span<Vec3> amplitudes);
// The same as `interpolate` for a surface with this normal, using only probes that count on its side of the
// grid's walls.
void interpolate(const Probes& probes, Vec3 position_ws, Vec3 normal, std::span<Vec3> coefficients);

// Gaussians only: writes function i as a lobe with coefficient i.
void to_lobes(const Basis& basis, std::span<const Vec3> coefficients, std::span<SphericalGaussian> lobes);

}  // namespace nook::probe
