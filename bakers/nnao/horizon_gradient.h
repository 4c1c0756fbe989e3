// Evaluates the horizon form on sixteen samples at once, and computes its gradient. nnao/network.h defines
// the form.
#pragma once

#include <span>
#include <vector>

#include "bakers/nnao/dataset.h"
#include "bakers/nnao/lanes.h"
#include "sdk/src/nnao/taps.h"

namespace nook::bake::nnao {

using nook::nnao::HorizonNetwork;
using nook::nnao::TapGrid;
using nook::nnao::TapNoise;

// Inputs of sixteen samples with the same number of taps.
struct HorizonBatch {
  // dot(n, t), dot(n, o).
  static constexpr int direction_gates = 2;
  // dot(n, o), distance from the screen's border.
  static constexpr int join_gates = 2;

  explicit HorizonBatch(TapGrid tap_grid);

  TapGrid grid;
  LaneArray tap;                      // tap_inputs for each tap, one direction after another
  LaneArray direction;                // direction_gates of each direction
  LaneArray tangent;                  // t of each direction, x, y, z
  Lanes normal[3]{}, view_axis[3]{};  // n, o
  Lanes join[join_gates]{};
  Lanes bound{};  // upper bound of 1 - AO

  void set(int lane, const View& view, const DataPoint& point, TapNoise noise);
};

// Values of the forward pass that the backward pass reads.
struct HorizonTrace {
  explicit HorizonTrace(TapGrid grid);

  LaneArray pooled, direction_sums, bent_sums;
  std::vector<int> most_step;  // the step with each direction's maximum, by unit and lane
  Lanes darkness;              // before the upper bound is applied
  Lanes joined[HorizonNetwork::units], join_sums[HorizonNetwork::units], join_output[HorizonNetwork::units];
};

// Outputs of the network, or gradients with respect to them.
struct HorizonOutput {
  Lanes ao{};       // before the clamp to [0, 1]
  Lanes bent[3]{};  // x, y, z, not normalised
};

// `parameters` are in the order of layers.h.
void horizon_forward(const float* parameters, const HorizonBatch& batch, HorizonTrace& trace,
                     HorizonOutput& output);

// Back-propagates output_gradient, and adds the result to `gradient` for each parameter and lane.
void horizon_backward(const float* parameters, const HorizonBatch& batch, const HorizonTrace& trace,
                      const HorizonOutput& output_gradient, Lanes* gradient);

}  // namespace nook::bake::nnao
