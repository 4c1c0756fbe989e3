// A neural tile forwards and backwards, on a few texels of views under the same number of lights each.
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

// Columns are positions, or samples: the lights of a position stand beside each other.
struct NeuralPass {
  using Columns = Eigen::MatrixXf;
  // Where the features of a position are read.
  struct Tap {
    std::uint32_t node[4], texel[4];
    float node_share[4], texel_share[4];
    float slope_x[4], slope_y[4];  // of texel_share, over texels
  };

  std::vector<NeuralPosition> positions;
  std::vector<Vec3> lights;  // position x light
  std::vector<Tap> taps;
  Columns offset_input, offset_units, heights, input, at_position, light_input, out;
  std::vector<Columns> units;  // of each hidden layer
  // Gradients: of the numbers of the networks, and channel x position.
  std::vector<float> weights;
  Columns features, offset_features;

  // Sets the heights of the positions alone.
  void find_heights(const NeuralNumbers& numbers);
  // Sets out: RGB of the samples.
  void forward(const NeuralNumbers& numbers);
  // Of the gradient in `out`, where the caller has put it.
  void backward(const NeuralNumbers& numbers);
  // Of the gradient in `heights`, where the caller has put it: adds to weights, and sets offset_features.
  void heights_backward(const NeuralNumbers& numbers);
  // Adds the gradients of features where they were read.
  void scatter(const NeuralShape& shape, std::span<float> feature_gradient,
               std::span<float> offset_gradient) const;
};

}  // namespace nook::bake::material
