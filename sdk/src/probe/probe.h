// Probes as plain data: one, or a grid of them that share their functions.
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
#include "sdk/src/probe/walls.h"

namespace nook::probe {

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
