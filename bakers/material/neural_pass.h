// Runs a neural tile forwards and backwards, on a few texels of views with the same number of lights each.
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
  std::vector<Columns> units;  // of each hidden layer
  // Gradients of the networks' numbers, and of features: channel x position.
  std::vector<float> weights;
  Columns features, offset_features;

  // Sets only the heights of the positions.
  void find_heights(const NeuralNumbers& numbers);
  // Sets out to the RGB of the samples.
  void forward(const NeuralNumbers& numbers);
  // Goes back from the gradient that the caller puts in `out`.
  void backward(const NeuralNumbers& numbers);
  // Goes back from the gradient that the caller puts in `heights`. Adds to weights, and sets offset_features.
  void heights_backward(const NeuralNumbers& numbers);
  // Adds the gradients of features where they were read.
  void scatter(const NeuralShape& shape, std::span<float> feature_gradient,
               std::span<float> offset_gradient) const;
};

}  // namespace nook::bake::material
