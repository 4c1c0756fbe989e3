#include "bakers/material/tile_filter.h"

#include <algorithm>
#include <cmath>

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

}  // namespace nook::bake::material
