#include "bakers/measure/material/neural_tile.h"

#include <algorithm>
#include <utility>

#include "bakers/measure/material/neural_pass.h"
#include "bakers/tensor/blocks.h"

namespace nook::bake::material {

using Eigen::Index;

NeuralLayout::NeuralLayout(const NeuralShape& s) {
  std::size_t end = 0;
  const auto take = [&end](std::size_t numbers) { return std::exchange(end, end + numbers); };
  offset_in = take(std::size_t(s.offset_channels + neural_view_inputs) * s.offset_units);
  offset_bias = take(s.offset_units);
  offset_out = take(s.offset_units);
  offset_level = take(1);
  position = take(std::size_t(s.channels + neural_view_inputs) * s.units);
  position_bias = take(s.units);
  light = take(std::size_t(neural_light_inputs) * s.units);
  hidden = take(std::size_t(s.layers - 1) * s.units * (s.units + 1));
  out = take(std::size_t(3) * s.units);
  out_bias = take(3);
  count = end;
}

std::size_t neural_bytes(const NeuralShape& s) {
  constexpr std::size_t block_bytes = 8, number_bytes = 2;
  const std::size_t blocks = std::size_t(s.width + 3) / 4 * ((s.height + 3) / 4);
  return block_bytes * blocks * (s.nodes() * s.channels + s.offset_channels) +
         number_bytes * NeuralLayout(s).count;
}

std::size_t NeuralTile::bytes() const {
  return neural_bytes(shape);
}

namespace {

using Features = Eigen::Map<const Eigen::ArrayXf>;
using RoundedFeatures = Eigen::Map<Eigen::ArrayXf>;

// All channels of the texels of a block, whose places are `at`.
void round_block(std::span<const std::size_t> at, Index channels, const float* features, float* rounded) {
  constexpr float steps = 255, levels = 7;
  Eigen::ArrayXf low = Features(features + at[0], channels), high = low;
  for (const std::size_t place : at) {
    low = low.min(Features(features + place, channels));
    high = high.max(Features(features + place, channels));
  }
  const auto to_byte = [](Eigen::ArrayXf& end) {
    end = ((end + 1) * (steps / 2) + 0.5f).floor() * (2 / steps) - 1;
  };
  to_byte(low);
  to_byte(high);
  const Eigen::ArrayXf step = (high - low) / levels, inverse = (step > 0).select(step.inverse(), 0.0f);
  for (const std::size_t place : at)
    RoundedFeatures(rounded + place, channels) =
        low +
        step * ((Features(features + place, channels) - low) * inverse + 0.5f).floor().max(0.0f).min(levels);
}

}  // namespace

void round_to_blocks(const NeuralShape& s, std::uint32_t channels, std::span<const float> features,
                     std::span<float> rounded) {
  const std::size_t along = (s.height + 3) / 4, blocks = (s.width + 3) / 4 * along,
                    images = features.size() / (s.texels() * channels);
  tensor::for_each_block(images * blocks, 64, [&](std::size_t first, std::size_t last) {
    std::vector<std::size_t> at;
    for (std::size_t b = first; b < last; ++b) {
      const std::size_t x = 4 * (b % blocks / along), y = 4 * (b % along);
      at.clear();
      for (std::size_t i = x; i < std::min<std::size_t>(x + 4, s.width); ++i)
        for (std::size_t j = y; j < std::min<std::size_t>(y + 4, s.height); ++j)
          at.push_back((b / blocks * s.texels() + i * s.height + j) * channels);
      round_block(at, channels, features.data(), rounded.data());
    }
  });
}

tensor::Matrix draw_neural_tile(const NeuralTile& tile, Vec3 view, std::span<const Vec3> lights) {
  constexpr std::size_t block = 64;
  const NeuralNumbers numbers{tile.shape, tile.features, tile.offset_features, tile.weights};
  tensor::Matrix drawn(Index(3 * lights.size()), Index(tile.shape.texels()));
  NeuralPass pass;
  for (std::size_t first = 0; first < tile.shape.texels(); first += block) {
    const std::size_t last = std::min(first + block, tile.shape.texels());
    pass.positions.clear();
    pass.lights.clear();
    for (std::size_t t = first; t < last; ++t) {
      pass.positions.push_back({view, std::uint32_t(t)});
      pass.lights.insert(pass.lights.end(), lights.begin(), lights.end());
    }
    pass.forward(numbers);
    for (std::size_t t = first; t < last; ++t)
      for (std::size_t l = 0; l < lights.size(); ++l)
        for (Index c = 0; c < 3; ++c)
          drawn(Index(3 * l) + c, Index(t)) =
              std::max(pass.out(c, Index((t - first) * lights.size() + l)), 0.0f);
  }
  return drawn;
}

BtfError measure_neural_tile(const RawMaterial& raw, const NeuralTile& tile) {
  const std::size_t views = raw.views.size(), texels = raw.texels();
  std::vector<BtfError> part(views);
  tensor::for_each_block(views, 1, [&](std::size_t view, std::size_t) {
    const tensor::Matrix drawn = draw_neural_tile(tile, raw.views[view], raw.lights);
    for (std::size_t row = 0; row < raw.light_rows(); ++row)
      add_error({&raw.btf[(row * views + view) * texels], texels}, drawn.row(Index(row)).data(), part[view]);
  });
  return sum_of_errors(part);
}

}  // namespace nook::bake::material
