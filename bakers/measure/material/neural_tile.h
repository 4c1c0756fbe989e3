// The same tile as a neural material: a small network over block-compressed features, after A. Kuznetsov, K.
// Mullia, Z. Xu, M. Hasan, R. Ramamoorthi: NeuMIP, 2021 (the neural offset) and C. Weinreich, L. de Oliveira,
// A. Houdard, G. Nader: Real-Time Neural Materials using Block-Compressed Features, 2023.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/material/raw_material.h"
#include "bakers/measure/material/measures.h"

namespace nook::bake::material {

// Sizes of a neural tile.
struct NeuralShape {
  std::uint32_t width = 0, height = 0;  // texels
  std::uint32_t channels = 16;          // of the features
  // Features are blended between as many nodes of a square map of views on each side; 1: they do not depend
  // on the view.
  std::uint32_t view_side = 1;
  float widest_view_z = 0;                               // at the rim of the map of views
  std::uint32_t units = 32;                              // of each hidden layer of the network
  std::uint32_t layers = 3;                              // hidden ones
  std::uint32_t offset_channels = 8, offset_units = 16;  // of the network of the offset

  std::size_t texels() const { return std::size_t(width) * height; }
  std::size_t nodes() const { return std::size_t(view_side) * view_side; }
};

// Where the numbers of each layer stand in NeuralTile::weights: matrices of outputs x inputs, inputs slow.
struct NeuralLayout {
  explicit NeuralLayout(const NeuralShape& shape);
  std::size_t offset_in, offset_bias, offset_out, offset_level;  // features and view -> units -> height
  std::size_t position, position_bias;                           // features and view -> units
  std::size_t light;                                             // light and half vector -> units
  std::size_t hidden;         // units -> units and their bias, for each layer
  std::size_t out, out_bias;  // units -> RGB
  std::size_t count;
};
inline constexpr std::uint32_t neural_view_inputs = 3, neural_light_inputs = 6;

struct NeuralTile {
  NeuralShape shape;
  // In [-1, 1], as decoded from BC4 blocks: of 4 x 4 texels of a channel.
  std::vector<float> features;         // node x texel x channel; a texel is x * height + y
  std::vector<float> offset_features;  // texel x channel
  std::vector<float> weights;          // half floats

  std::size_t bytes() const;
};

// Blocks of eight bytes and numbers of two.
std::size_t neural_bytes(const NeuralShape& shape);

// The features that BC4 decodes after encoding: each block of 4 x 4 texels of a channel has two ends of eight
// bits, and eight levels between them.
void round_to_blocks(const NeuralShape& shape, std::uint32_t channels, std::span<const float> features,
                     std::span<float> rounded);

// The radiance of the plane's texels in a view for each light, 3 lights x texels, as in RawMaterial::btf.
tensor::Matrix draw_neural_tile(const NeuralTile& tile, Vec3 view, std::span<const Vec3> lights);

BtfError measure_neural_tile(const RawMaterial& raw, const NeuralTile& tile);

}  // namespace nook::bake::material
