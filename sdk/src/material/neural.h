// A material as a small neural network. The network reads features that are stored for each texel, and
// replaces the clustered BTF. The method follows A. Kuznetsov, K. Mullia, Z. Xu, M. Hasan, R. Ramamoorthi:
// NeuMIP, 2021 (the neural offset) and C. Weinreich, L. de Oliveira, A. Houdard, G. Nader: Real-Time Neural
// Materials using Block-Compressed Features, 2023.
//
// All layers are matrices, features are filtered linearly at a point of the tile, and r(x) = max(x, x / 100):
//   height   = offset_out r(offset_in (offset features at uv, view, 1)) + offset_level
//   decoded  = position (features at uv + view.xy / view.z height, view, 1)
//   units    = r(decoded + light_weights (light, half vector)), and for each further layer
//   units    = r(hidden (units, 1))
//   radiance = max(out (units, 1), 0)
// `height` and `decoded` do not depend on the light, so they are computed once per pixel.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/material/signed_blocks.h"

namespace nook::material {

struct NeuralShape {
  std::uint32_t width = 0, height = 0;                   // texels
  std::uint32_t channels = 16;                           // number of channels of the features
  std::uint32_t units = 32;                              // units of each hidden layer
  std::uint32_t layers = 3;                              // number of hidden layers
  std::uint32_t offset_channels = 8, offset_units = 16;  // channels and units of the neural offset

  std::size_t texels() const { return std::size_t(width) * height; }
  std::size_t blocks() const { return std::size_t(width + 3) / 4 * ((height + 3) / 4); }

  bool operator==(const NeuralShape&) const = default;
};

inline constexpr std::uint32_t neural_view_inputs = 3, neural_light_inputs = 6;

// The offset of each layer in the array of weights. A matrix is outputs x inputs, and the output index varies
// fastest. The bias follows the matrix. It is the row of weights for a constant input of 1.
struct NeuralLayout {
  explicit NeuralLayout(const NeuralShape& shape);
  std::size_t offset_in, offset_bias, offset_out, offset_level;  // features and view -> units -> height
  std::size_t position, position_bias;                           // features and view -> units
  std::size_t light;                                             // light and half vector -> units
  std::size_t hidden;         // units -> units and their bias, for each layer
  std::size_t out, out_bias;  // units -> RGB
  std::size_t count;
};

// Returns the offset of a hidden layer's weights. Do not call it for layer 0: that layer's weights are
// `position` and `light`.
constexpr std::size_t neural_hidden_layer(const NeuralShape& s, const NeuralLayout& at, std::size_t layer) {
  return at.hidden + (layer - 1) * s.units * (s.units + 1);
}

// The slope of the activation function r for negative values.
inline constexpr float neural_leak = 0.01f;

// Features are multiples of 1 / 127 in [-1, 1], as in textures of signed bytes. A block of 4 x 4 texels of
// one channel takes eight bytes, in the RGTC format of signed_blocks.h.
inline constexpr int neural_feature_steps = signed_block_steps;
inline constexpr std::size_t neural_block_bytes = signed_block_bytes;
// Decodes a code of a block to the nearest integer level. `upper` must not be below `lower`.
constexpr int neural_level(int upper, int lower, std::uint32_t code) {
  const int down = sevenths_of(code);
  const int sum = upper * (7 - down) + lower * down;
  return (sum >= 0 ? sum + 3 : sum - 3) / 7;
}

struct Neural {
  explicit Neural(Memory* memory = default_memory()) : blocks(memory), weights(memory) {}

  NeuralShape shape;
  // Channel x block row x block column. The channels of the features come first, then the channels of the
  // offset features.
  Vector<std::uint8_t> blocks;
  Vector<std::uint16_t> weights;  // half floats; empty: the material is a clustered tensor

  bool is_used() const { return !weights.empty(); }
};

// These functions return the size of the blocks and the size of the weights in bytes.
inline std::size_t neural_block_bytes_of(const NeuralShape& s) {
  return neural_block_bytes * s.blocks() * (s.channels + s.offset_channels);
}
inline std::size_t neural_bytes(const NeuralShape& s) {
  return neural_block_bytes_of(s) + 2 * NeuralLayout(s).count;
}

// Functions that the training and the decoder share.

// The place where features are read is shifted by view.xy / view.z times the height. These constants are the
// limits of view.z and of the height. Without the limits, grazing views would read features arbitrarily far
// away, and a faulty network could return heights of a tile or more.
inline constexpr float neural_least_view_z = 0.01f;
inline float neural_slope(Vec3 view) {
  return 1 / std::max(view.z, neural_least_view_z);
}
inline float neural_shift(float height, Vec3 view) {
  return height > -1 && height < 1 ? height * neural_slope(view) : 0.0f;
}

// The vector halfway between two directions.
inline Vec3 neural_half(Vec3 view, Vec3 light) {
  const Vec3 sum = view + light;
  return sum * (1 / std::max(length(sum), 1e-6f));
}

}  // namespace nook::material
