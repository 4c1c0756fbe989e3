#include "sdk/src/transfer/distant_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sdk/src/core/spherical_gaussian.h"

namespace nook::transfer {

void lobe_axes(std::span<Vec3> axes) {
  constexpr double golden_angle = std::numbers::pi * (3 - 2.23606797749978969641);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double z = 1 - 2 * (double(i) + 0.5) / double(axes.size());
    const double r = std::sqrt(1 - z * z), azimuth = golden_angle * double(i);
    axes[i] = {float(r * std::cos(azimuth)), float(r * std::sin(azimuth)), float(z)};
  }
}

std::array<Vec3, band_count> bands_of_lobes(std::span<const Vec3> axes, float sharpness,
                                            std::span<const float> amplitudes) {
  std::array<Vec3, band_count> sums{};
  for (std::size_t j = 0; j < axes.size(); ++j) {
    const Vec3 amplitude{amplitudes[3 * j], amplitudes[3 * j + 1], amplitudes[3 * j + 2]};
    const std::array<float, band_count> at = bands_at(axes[j]);
    for (std::uint32_t k = 0; k < band_count; ++k) sums[k] += amplitude * at[k];
  }
  // A lobe is zonal around its axis. Its harmonics are the harmonics of a point light along the axis, times
  // one factor for each band.
  const std::array<float, 5> band = gaussian_bands(sharpness);
  const float whole = gaussian_integral(sharpness);
  for (std::uint32_t k = 0; k < band_count; ++k)
    sums[k] = sums[k] * (whole * band[k == 0 ? 0 : k < 4 ? 1 : 2]);
  return sums;
}

namespace {

constexpr double pi = std::numbers::pi;

std::size_t nearest_texel(const MapView& map, Vec3 d) {
  if (map.layout == MapLayout::cube) return cube_cell_at(d, map.width);
  const float u = 0.5f + std::atan2(d.z, d.x) * float(0.5 / pi);
  const float v = std::atan2(std::sqrt(d.x * d.x + d.z * d.z), d.y) * float(1 / pi);
  const auto column = std::min(std::uint32_t(std::max(u, 0.0f) * float(map.width)), map.width - 1);
  const auto row = std::min(std::uint32_t(std::max(v, 0.0f) * float(map.height)), map.height - 1);
  return std::size_t(row) * map.width + column;
}

}  // namespace

CubeCells::CubeCells(std::uint32_t side_, Memory* memory)
    : side(side_), direction(memory), solid_angle(memory) {
  direction.reserve(std::size_t(6) * side * side);
  solid_angle.reserve(std::size_t(6) * side * side);
  for (std::uint32_t face = 0; face < 6; ++face)
    for (std::uint32_t row = 0; row < side; ++row)
      for (std::uint32_t column = 0; column < side; ++column) {
        direction.push_back(cube_cell_direction(face, column, row, side));
        solid_angle.push_back(float(cube_cell_angle(column, row, side)));
      }
}

Vector<Vec3> cell_means(const MapView& map, const CubeCells& cells, Memory* memory) {
  struct Sum {
    std::array<double, 3> rgb{};
    double weight = 0;
  };
  Vector<Sum> sums(cells.size(), Sum{}, memory);
  for (std::uint32_t row = 0; row < map.height; ++row)
    for (std::uint32_t column = 0; column < map.width; ++column) {
      const MapTexel at = map_texel(map, column, row);
      const Vec3 rgb = map.texel(std::size_t(row) * map.width + column);
      Sum& sum = sums[cube_cell_at(at.direction, cells.side)];
      sum.rgb[0] += double(rgb.x) * at.solid_angle;
      sum.rgb[1] += double(rgb.y) * at.solid_angle;
      sum.rgb[2] += double(rgb.z) * at.solid_angle;
      sum.weight += at.solid_angle;
    }
  Vector<Vec3> means(cells.size(), Vec3{}, memory);
  for (std::size_t i = 0; i < means.size(); ++i) {
    const Sum& sum = sums[i];
    means[i] = sum.weight > 0 ? Vec3{float(sum.rgb[0] / sum.weight), float(sum.rgb[1] / sum.weight),
                                     float(sum.rgb[2] / sum.weight)}
                              : map.texel(nearest_texel(map, cells.direction[i]));
  }
  return means;
}

}  // namespace nook::transfer
