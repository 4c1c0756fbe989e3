// A neural material stores a tile in a small network over block-compressed features. It follows A. Kuznetsov,
// K. Mullia, Z. Xu, M. Hasan, R. Ramamoorthi: NeuMIP, 2021 (the neural offset) and C. Weinreich, L. de
// Oliveira, A. Houdard, G. Nader: Real-Time Neural Materials using Block-Compressed Features, 2023.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/material/raw_material.h"
#include "bakers/tensor/tensor.h"
#include "sdk/src/material/neural.h"

namespace nook::bake::material {

// Sizes of a neural tile. During training, features may depend on the view. In a file, they cannot.
struct NeuralShape : nook::material::NeuralShape {
  // Number of nodes along each side of a square map of views. Features are interpolated between nodes. If it
  // is 1, features do not depend on the view.
  std::uint32_t view_side = 1;
  float widest_view_z = 0;  // z of the views at the rim of the map of views

  std::size_t nodes() const { return std::size_t(view_side) * view_side; }
};
using nook::material::neural_light_inputs, nook::material::neural_view_inputs, nook::material::NeuralLayout;

struct NeuralTile {
  NeuralShape shape;
  // In [-1, 1], as decoded from the blocks of sdk's material/neural.h.
  std::vector<float> features;         // node x texel x channel; a texel is x * height + y
  std::vector<float> offset_features;  // texel x channel
  std::vector<float> weights;          // half floats

  std::size_t bytes() const;
};

// Returns the size in bytes: blocks take eight bytes, weights take two.
std::size_t neural_bytes(const NeuralShape& shape);

// Encodes and decodes the features. Each block of 4 x 4 texels of a channel has two endpoints and eight
// levels from one to the other, which are multiples of 1 / 127.
void round_to_blocks(const NeuralShape& shape, std::uint32_t channels, std::span<const float> features,
                     std::span<float> rounded);

// Returns the radiance of the plane's texels in one view for each light, 3 lights x texels, in the order of
// RawMaterial::btf.
tensor::Matrix draw_neural_tile(const NeuralTile& tile, Vec3 view, std::span<const Vec3> lights);

// Converts the tile to the form that a file stores. Pads channels and units to multiples of 4. Throws
// Failure(NOOK_ERROR_INVALID_ARGUMENT) if features depend on the view.
nook::material::Neural encoded(const NeuralTile& tile);

}  // namespace nook::bake::material
