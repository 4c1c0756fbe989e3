// Distant light in the forms that transfer uses: lobes, bands, and the cells of a cube, from which lobes are
// fitted.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/light_map.h"
#include "sdk/src/core/vec.h"

namespace nook::transfer {

inline constexpr std::uint32_t min_lobes = 12;
// The largest number in the paper's Table II; its factored Gram matrix takes 25 MiB.
inline constexpr std::uint32_t max_lobes = 2562;

// The factor may be between 0.2 and 0.5: wider lobes represent suns better and broad light worse. 0.35 is the
// best compromise over maps of a sun, of windows and of clouds (docs/transfer.md).
constexpr float sharpness_of(std::uint32_t lobes) {
  return 0.35f * float(lobes);
}

// H. Vogel's spiral: azimuths differ by the golden angle, and heights z run from 1 to -1 at the centres of
// equal areas.
void lobe_axes(std::span<Vec3> axes);

// Distant light by its bands 0 to 2: nine real spherical harmonics, orthonormal over the sphere (P.-P. Sloan,
// Stupid Spherical Harmonics Tricks, 2008). Inter-reflections of a shape are smooth, so these bands are
// enough for them.

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

// Returns bands 0 to 2 of the light of lobes with one sharpness; amplitudes has axes x RGB.
std::array<Vec3, band_count> bands_of_lobes(std::span<const Vec3> axes, float sharpness,
                                            std::span<const float> amplitudes);

// Distant light as the mean radiance of the cells of a cube around the origin, from which lobes are fitted in
// any rotation.

// A cube has side x side cells a face, and the faces +x, -x, +y, -y, +z, -z. Cells are squares of a face;
// their solid angles differ by up to a factor of 5.
struct CubeCells {
  explicit CubeCells(std::uint32_t side, Memory* memory = default_memory());

  std::uint32_t side;
  Vector<Vec3> direction;     // unit, through the centre of each cell
  Vector<float> solid_angle;  // steradians; their sum is 4 pi

  std::size_t size() const { return direction.size(); }
};

// Returns the mean radiance of each cell, over the texels in it. If a map has fewer texels than there are
// cells, the nearest texel counts.
Vector<Vec3> cell_means(const MapView& map, const CubeCells& cells, Memory* memory);

}  // namespace nook::transfer
