// Runs a neural tile forwards and backwards on some texels in views. Each position has the same number of
// lights.
#pragma once

#include <Eigen/Core>

#include "bakers/material/neural_tile.h"

namespace nook::bake::material {

// A texel in a view.
struct NeuralPosition {
  Vec3 view;
  std::uint32_t texel = 0;
};

struct NeuralNumbers {
  const NeuralShape& shape;
  std::span<const float> features, offset_features, weights;
};

// Columns are positions or samples. The lights of a position are adjacent samples.
struct NeuralPass {
  using Columns = Eigen::MatrixXf;
  // The texels where the features of a position are read.
  struct Tap {
    std::uint32_t node[4], texel[4];
    float node_share[4], texel_share[4];
    float slope_x[4], slope_y[4];  // derivatives of texel_share, per texel
  };

  std::vector<NeuralPosition> positions;
  std::vector<Vec3> lights;  // position x light
  std::vector<Tap> taps;
  Columns offset_input, offset_units, heights, input, at_position, light_input, out;
  std::vector<Columns> units;  // outputs of each hidden layer
  // Gradients of the networks' weights, and of the features (channel x position).
  std::vector<float> weights;
  Columns features, offset_features;

  // Computes only the heights of the positions.
  void find_heights(const NeuralNumbers& numbers);
  // Writes the RGB of the samples to `out`.
  void forward(const NeuralNumbers& numbers);
  // Runs backwards from a gradient. Before the call, write the gradient to `out`.
  void backward(const NeuralNumbers& numbers);
  // Runs backwards from a gradient of the heights. Before the call, write it to `heights`. Adds the gradient
  // to `weights`, and overwrites `offset_features`.
  void heights_backward(const NeuralNumbers& numbers);
  // Adds the gradients of features to the texels where the features were read.
  void scatter(const NeuralShape& shape, std::span<float> feature_gradient,
               std::span<float> offset_gradient) const;
};

}  // namespace nook::bake::material
