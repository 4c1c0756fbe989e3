#include "bakers/material/neural_tile.h"

#include <algorithm>
#include <cmath>

#include "bakers/material/neural_pass.h"
#include "bakers/tensor/blocks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"

namespace nook::bake::material {

using Eigen::Index;
using nook::material::RgtcBlock;

std::size_t neural_bytes(const NeuralShape& s) {
  const std::size_t blocks = s.blocks() * (s.nodes() * s.channels + s.offset_channels);
  return nook::material::neural_block_bytes * blocks + 2 * NeuralLayout(s).count;
}

std::size_t NeuralTile::bytes() const {
  return neural_bytes(shape);
}

namespace {

// The places where one channel stores the features of a block's texels, row by row. A block that reaches
// beyond the border of the tile repeats the last texels.
struct BlockPlaces {
  std::size_t at[16];
};

BlockPlaces places_of(const NeuralShape& s, std::uint32_t channels, std::size_t block) {
  const std::uint32_t columns = (s.width + 3) / 4;
  const auto x = std::uint32_t(block % columns * 4), y = std::uint32_t(block / columns * 4);
  BlockPlaces places{};
  for (std::uint32_t i = 0; i < 16; ++i)
    places.at[i] =
        (std::size_t(std::min(x + i % 4, s.width - 1)) * s.height + std::min(y + i / 4, s.height - 1)) *
        channels;
  return places;
}

float level(const RgtcBlock& block, int i) {
  return float(nook::material::neural_level(block.upper, block.lower, block.code[i])) /
         nook::material::neural_feature_steps;
}

RgtcBlock encode(const BlockPlaces& places, const float* features) {
  constexpr float steps = nook::material::neural_feature_steps, levels = 7;
  float low = features[places.at[0]], high = low;
  for (const std::size_t place : places.at) {
    low = std::min(low, features[place]);
    high = std::max(high, features[place]);
  }
  RgtcBlock block;
  block.upper = std::int8_t(std::floor(high * steps + 0.5f));
  block.lower = std::int8_t(std::floor(low * steps + 0.5f));
  const float scale = block.upper > block.lower ? levels / float(block.upper - block.lower) : 0;
  for (int i = 0; i < 16; ++i) {
    const float down = (float(block.upper) - steps * features[places.at[i]]) * scale;
    block.code[i] = nook::material::code_of(std::clamp(int(std::floor(down + 0.5f)), 0, 7));
  }
  return block;
}

void append(const RgtcBlock& block, Vector<std::uint8_t>& bytes) {
  bytes.resize(bytes.size() + nook::material::signed_block_bytes);
  write_rgtc(block, &bytes[bytes.size() - nook::material::signed_block_bytes]);
}

void append_channels(const NeuralShape& s, std::uint32_t channels, const std::vector<float>& features,
                     Vector<std::uint8_t>& bytes) {
  for (std::uint32_t channel = 0; channel < channels; ++channel)
    for (std::size_t b = 0; b < s.blocks(); ++b)
      append(encode(places_of(s, channels, b), &features[channel]), bytes);
}

}  // namespace

void round_to_blocks(const NeuralShape& s, std::uint32_t channels, std::span<const float> features,
                     std::span<float> rounded) {
  const std::size_t image = s.texels() * channels, blocks = s.blocks();
  tensor::for_each_block(features.size() / image * blocks, 64, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b) {
      const BlockPlaces places = places_of(s, channels, b % blocks);
      for (std::uint32_t channel = 0; channel < channels; ++channel) {
        const std::size_t at = b / blocks * image + channel;
        const RgtcBlock block = encode(places, &features[at]);
        for (int i = 0; i < 16; ++i) rounded[at + places.at[i]] = level(block, i);
      }
    }
  });
}

nook::material::Neural encoded(const NeuralTile& tile) {
  if (tile.shape.view_side != 1)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "a file cannot store a neural material whose features depend "
                  "on the view (got a grid of %u x %u views)",
                  tile.shape.view_side, tile.shape.view_side);
  nook::material::Neural neural;
  neural.shape = tile.shape;
  append_channels(tile.shape, tile.shape.channels, tile.features, neural.blocks);
  append_channels(tile.shape, tile.shape.offset_channels, tile.offset_features, neural.blocks);
  for (const float weight : tile.weights) neural.weights.push_back(to_half(weight));
  return neural;
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

}  // namespace nook::bake::material
