#include "bakers/material/periodic_tile.h"

#include <algorithm>
#include <numbers>

#include "bakers/raytrace/hemisphere.h"

namespace nook::bake::material {

TileFilter::TileFilter(std::uint32_t width, std::uint32_t height, std::uint32_t side, std::uint32_t channels)
    : channels_(channels),
      along_x_(shares_of(width, side)),
      along_y_(shares_of(height, side)),
      sum_(std::size_t(side) * side * channels),
      row_(std::size_t(side) * channels) {}

std::vector<std::vector<TileFilter::Share>> TileFilter::shares_of(std::uint32_t size, std::uint32_t side) {
  const double radius = std::max(1.0 / side, 1.0 / size);
  std::vector<std::vector<Share>> shares(size);
  for (std::uint32_t p = 0; p < side; ++p) {
    const double centre = (p + 0.5) / side;
    const auto first = std::int64_t(std::floor((centre - radius) * size - 0.5)),
               last = std::int64_t(std::ceil((centre + radius) * size - 0.5));
    const auto weight_of = [&](std::int64_t texel) {
      return std::max(0.0, 1 - std::abs((double(texel) + 0.5) / size - centre) / radius);
    };
    double sum = 0;
    for (std::int64_t t = first; t <= last; ++t) sum += weight_of(t);
    for (std::int64_t t = first; t <= last; ++t)
      if (const double weight = weight_of(t); weight > 0)
        shares[std::size_t((t % size + size) % size)].push_back({p, weight / sum});
  }
  return shares;
}

void TileFilter::add_row(std::uint32_t index, std::span<const float> row) {
  std::fill(row_.begin(), row_.end(), 0.0);
  for (std::size_t x = 0; x < along_x_.size(); ++x)
    for (const Share& share : along_x_[x])
      for (std::size_t c = 0; c < channels_; ++c)
        row_[share.point * channels_ + c] += share.weight * double(row[x * channels_ + c]);
  for (const Share& share : along_y_[index])
    for (std::size_t i = 0; i < row_.size(); ++i)
      sum_[share.point * row_.size() + i] += share.weight * row_[i];
}

std::vector<float> TileFilter::result() const {
  return {sum_.begin(), sum_.end()};
}

namespace {

Vec3 lattice_gradient(std::int64_t x, std::int64_t y, std::int64_t z, std::uint32_t cells,
                      std::uint64_t seed) {
  const auto wrap = [cells](std::int64_t i) { return std::uint64_t((i % cells + cells) % cells); };
  const std::uint64_t bits =
      mix_bits(seed ^ mix_bits(wrap(x) | wrap(y) << 20 | std::uint64_t(z + (1 << 20)) << 40));
  const float height = 2 * unit_float(bits) - 1;
  const float angle = 2 * std::numbers::pi_v<float> * unit_float(mix_bits(bits));
  const float radius = std::sqrt(1 - height * height);
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

float fade(float t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}
float mix(float a, float b, float t) {
  return a + (b - a) * t;
}

}  // namespace

float tile_noise(Vec3 p, std::uint32_t cells, std::uint64_t seed) {
  const Vec3 q = p * float(cells);
  const Vec3 base{std::floor(q.x), std::floor(q.y), std::floor(q.z)};
  const Vec3 f = q - base;
  float corner[8];
  for (int i = 0; i < 8; ++i) {
    const Vec3 offset{float(i & 1), float(i >> 1 & 1), float(i >> 2)};
    const Vec3 gradient = lattice_gradient(std::int64_t(base.x + offset.x), std::int64_t(base.y + offset.y),
                                           std::int64_t(base.z + offset.z), cells, seed);
    corner[i] = dot(gradient, f - offset);
  }
  const float u = fade(f.x), v = fade(f.y), w = fade(f.z);
  const float low = mix(mix(corner[0], corner[1], u), mix(corner[2], corner[3], u), v);
  const float high = mix(mix(corner[4], corner[5], u), mix(corner[6], corner[7], u), v);
  // With unit gradients, Perlin noise is within about +-0.87.
  return mix(low, high, w) / 0.87f;
}

float tile_fractal_noise(Vec3 p, std::uint32_t cells, std::uint32_t octaves, std::uint64_t seed) {
  float sum = 0, amplitude = 1;
  for (std::uint32_t i = 0; i < octaves; ++i, cells *= 2, amplitude /= 2)
    sum += amplitude * tile_noise(p, cells, seed + i);
  return sum;
}

}  // namespace nook::bake::material
