// Trains a neural tile on a raw material.
#pragma once

#include "bakers/material/compression.h"
#include "bakers/material/neural_tile.h"

namespace nook::bake::material {

struct NeuralSettings {
  NeuralShape shape;  // width, height and widest_view_z are set from the raw material
  std::uint32_t steps = 8000;
  std::uint32_t offset_steps = 3000;           // steps that train only the offset, before all other training
  std::uint32_t positions = 1024, lights = 8;  // per step: texels in views, and lights for each of them
  float rate = 3e-3f, feature_rate = 1e-2f;    // initial rates of Adam for weights and features
  std::uint64_t seed = 1;
};

// Returns the shape with 2 to 64 channels that fills this many bytes. It has as many view nodes as the raw
// material has views, or fewer if that is needed for 16 channels. The smallest shape may take more than
// `bytes`.
NeuralShape filling_neural_shape(const RawMaterial& raw, std::size_t bytes);

// Runs Adam on the squared error of linear radiance, with cosine decay of the rates to 0. The offset is
// initialised from the relief at which the views agree. In the second half of the steps, features are rounded
// to blocks, and the gradient passes straight through the rounding. The same seed gives the same bits on any
// number of threads. Throws Failure(CANCELLED) if progress returns false.
NeuralTile fit_neural_tile(const RawMaterial& raw, const NeuralSettings& settings,
                           const StageProgress& progress = {});

}  // namespace nook::bake::material
