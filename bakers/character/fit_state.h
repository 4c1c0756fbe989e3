// The data that a fit reads and the state that it changes.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bakers/character/non_linear_layer.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"

namespace nook::bake {

// Poses with their ray-traced AO. The last `held_out` poses are not fitted. They decide when the fit stops.
struct TrainingSet {
  std::vector<Pose> poses;
  AoTargets targets;                 // poses x welded vertices
  std::vector<float> vertex_weight;  // weight of the squared error, mean 1
  std::size_t held_out = 0;

  std::size_t fitted() const { return poses.size() - held_out; }
};

// The linear layer during the fit: AO = 1 - (sum alpha * shadow + bias), with a fixed number of entries per
// vertex.
struct LinearLayerFit {
  std::size_t entries = 0;
  std::vector<std::uint16_t> key_point;  // vertices x entries
  std::vector<float> alpha;              // same shape, >= floor
  std::vector<float> floor;              // same shape, >= 0: the minimum weight of an entry; empty: all 0
  std::vector<float> bias;               // one per vertex

  std::size_t vertex_count() const { return bias.size(); }
};

struct FitState {
  LayerStructure structure;
  std::vector<float> parameters;  // non-linear layer, see LayerStructure
  LinearLayerFit linear;
};

// Returns the shadows of many poses: poses x padded key points, row-major. Runs in parallel over poses.
std::vector<float> shadows_of(const FitState& state, std::span<const Pose> poses);

struct FitError {
  double mse = 0;       // over all vertices and poses
  double mse_area = 0;  // weighted by the given vertex weights
};
// Compares clamped predictions with unclamped targets, over poses [first, last) of the set.
FitError measure_fit(const FitState& state, const TrainingSet& set, std::size_t first, std::size_t last,
                     std::span<const float> vertex_area);

}  // namespace nook::bake
