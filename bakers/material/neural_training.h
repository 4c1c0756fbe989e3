// Training of a neural tile on a raw material.
#pragma once

#include "bakers/material/compression.h"
#include "bakers/material/neural_tile.h"

namespace nook::bake::material {

struct NeuralSettings {
  NeuralShape shape;  // width, height and widest_view_z are set from the raw material
  std::uint32_t steps = 8000;
  std::uint32_t offset_steps = 3000;           // for training the offset alone, before the rest
  std::uint32_t positions = 1024, lights = 8;  // per step: texels in views, and lights of each
  float rate = 3e-3f, feature_rate = 1e-2f;    // initial rates of Adam for weights and features
  std::uint64_t seed = 1;
};

// Returns the shape with 2 to 64 channels that fills this many bytes. It has as many nodes of views as the
// raw material, or the most with which there are 16 channels. The smallest shape may take more bytes.
NeuralShape filling_neural_shape(const RawMaterial& raw, std::size_t bytes);

// Runs Adam on the squared error of linear radiance, with rates that fall to 0 along a half cosine. The
// offset begins at the relief at which views agree. In the second half of the steps, features are rounded to
// blocks and take the gradient of their rounded values. The same seed gives the same bits on any number of
// threads. Throws Failure(CANCELLED) if progress returns false.
NeuralTile fit_neural_tile(const RawMaterial& raw, const NeuralSettings& settings,
                           const StageProgress& progress = {});

}  // namespace nook::bake::material
