// Images and noise on a tile that repeats.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/vec.h"

namespace nook::bake::material {

// Reads images of a repeating tile with linear interpolation. The texel index is x * height + y, as in
// RawMaterial.

// The four texels around a point and their interpolation weights.
struct Taps {
  std::size_t texel[4];
  float share[4];
};

// x and y are in tiles.
inline Taps taps_at(std::uint32_t width, std::uint32_t height, float x, float y) {
  const float across = x * float(width) - 0.5f, along = y * float(height) - 0.5f;
  const float left = std::floor(across), low = std::floor(along);
  const float fx = across - left, fy = along - low;
  const auto wrap = [](float at, std::uint32_t side) {
    const long whole = std::lround(at) % long(side);
    return std::size_t(whole < 0 ? whole + long(side) : whole);
  };
  Taps taps{};
  for (int i = 0; i < 4; ++i) {
    const bool right = i & 1, high = i & 2;
    taps.texel[i] = wrap(left + float(right), width) * height + wrap(low + float(high), height);
    taps.share[i] = (right ? fx : 1 - fx) * (high ? fy : 1 - fy);
  }
  return taps;
}

template <class Value>
Value mean_of(const Taps& taps, const Value* map) {
  Value sum = taps.share[0] * map[taps.texel[0]];
  for (int i = 1; i < 4; ++i) sum = sum + taps.share[i] * map[taps.texel[i]];
  return sum;
}

// Averages an image over the points of another grid on a repeating tile.

// Rows are passed one by one, so that the filter need not store the whole image. A grid point ((x + 0.5) /
// side, (y + 0.5) / side) gets the mean of the image under a tent filter with the width of two grid points.
// If the image is coarser than the grid, the tent is as wide as two texels, which is bilinear interpolation.
class TileFilter {
 public:
  TileFilter(std::uint32_t width, std::uint32_t height, std::uint32_t side, std::uint32_t channels);

  // `row` has width x channels values. The texel centres of the row are at y = (index + 0.5) / height.
  void add_row(std::uint32_t index, std::span<const float> row);

  // Call this after all rows were added. Returns the channels of point y * side + x, one point after another.
  std::vector<float> result() const;

 private:
  struct Share {
    std::uint32_t point;
    double weight;
  };
  // For each texel along an axis, returns the points that it contributes to.
  static std::vector<std::vector<Share>> shares_of(std::uint32_t size, std::uint32_t side);

  std::uint32_t channels_;
  std::vector<std::vector<Share>> along_x_, along_y_;
  std::vector<double> sum_, row_;
};

// Gradient noise that repeats along x and y.

// Returns Perlin noise, from about -1 to 1, with `cells` lattice cells along a tile's side. It repeats after
// 1 along x and y, but not along z.
float tile_noise(Vec3 p, std::uint32_t cells, std::uint64_t seed);

// Adds octaves of tile_noise, each with twice the frequency and half the amplitude.
float tile_fractal_noise(Vec3 p, std::uint32_t cells, std::uint32_t octaves, std::uint64_t seed);

}  // namespace nook::bake::material
