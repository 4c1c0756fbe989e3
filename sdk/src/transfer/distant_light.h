// The three representations of distant light in radiance transfer: lobes, spherical-harmonic bands, and the
// cells of a cube. Lobes are fitted to the cells.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/light_map.h"
#include "sdk/src/core/vec.h"

namespace nook::transfer {

inline constexpr std::uint32_t min_lobes = 12;
// The largest number of lobes in the paper's Table II. Their factored Gram matrix takes 25 MiB.
inline constexpr std::uint32_t max_lobes = 2562;

// Returns the sharpness of the lobes. Useful factors are 0.2 to 0.5: wider lobes represent suns better, but
// broad light worse. 0.35 is the best compromise over maps of a sun, of windows and of clouds
// (docs/transfer.md).
constexpr float sharpness_of(std::uint32_t lobes) {
  return 0.35f * float(lobes);
}

// Fills `axes` with H. Vogel's spiral. Successive azimuths differ by the golden angle. The heights z go from
// 1 to -1. Each point is at the middle height of a zone, and all zones have equal area.
void lobe_axes(std::span<Vec3> axes);

// Distant light as spherical-harmonic bands 0 to 2: nine real harmonics, orthonormal over the sphere (P.-P.
// Sloan, Stupid Spherical Harmonics Tricks, 2008). These bands are sufficient for inter-reflections of a
// shape, because inter-reflections are smooth.

inline constexpr std::uint32_t band_count = 9;

constexpr std::array<float, band_count> bands_at(Vec3 d) {
  return {0.2820948f,
          0.4886025f * d.y,
          0.4886025f * d.z,
          0.4886025f * d.x,
          1.0925484f * d.x * d.y,
          1.0925484f * d.y * d.z,
          0.3153916f * (3 * d.z * d.z - 1),
          1.0925484f * d.x * d.z,
          0.5462742f * (d.x * d.x - d.y * d.y)};
}

// Returns bands 0 to 2 of the light of lobes that all have the same sharpness. `amplitudes` has an RGB value
// for each axis.
std::array<Vec3, band_count> bands_of_lobes(std::span<const Vec3> axes, float sharpness,
                                            std::span<const float> amplitudes);

// Distant light as the mean radiance of the cells of a cube around the origin. Lobes can be fitted to the
// cells in any rotation.

// A cube has the faces +x, -x, +y, -y, +z, -z, and side x side cells on each face. Cells are squares on a
// face, and their solid angles differ by up to a factor of 5.
struct CubeCells {
  explicit CubeCells(std::uint32_t side, Memory* memory = default_memory());

  std::uint32_t side;
  Vector<Vec3> direction;     // unit, through the centre of each cell
  Vector<float> solid_angle;  // steradians; their sum is 4 pi

  std::size_t size() const { return direction.size(); }
};

// Returns the mean radiance of each cell over the texels of the map that lie in the cell. If the map is so
// small that no texel lies in a cell, the cell gets the value of the nearest texel.
Vector<Vec3> cell_means(const MapView& map, const CubeCells& cells, Memory* memory);

}  // namespace nook::transfer
