// Fits the linear layer by constrained least squares: a few key points per vertex, non-negative weights, and
// a bias without bounds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/character/fit_state.h"

namespace nook::bake {

// The key points that each vertex may use, nearest first: vertices x count.
struct Candidates {
  std::size_t count = 0;
  std::vector<std::uint16_t> key_point;
  std::vector<float> nearness;  // same shape, > 0, descending per vertex; empty: all equal
};

struct LinearFitSettings {
  std::size_t entries = 7;   // at most this many key points per vertex
  double ridge = 1e-4;       // ridge for alpha, relative to the mean variance of the shadows
  double least_gain = 1e-3;  // an entry must lower the vertex's squared error by at least this share of the
                             // vertex's variance
  // The first `anchors` candidates of a vertex are the key points nearest to it. They always get an entry.
  // Their weights sum to at least anchor_floor, which they share by nearness. The occlusion by other casters
  // is interpolated from the same entries, so it needs key points nearby.
  std::size_t anchors = 3;
  double anchor_floor = 0.06;
};

// Solves for alpha and bias of every vertex over the fitted poses of the set. All vertices share the Gram
// matrix of the shadows, so the cost of a vertex depends only on its number of candidates. This applies the
// paper's caching (slides 55 to 57) to the linear layer.
LinearLayerFit fit_linear_layer(std::span<const float> shadows, std::size_t padded, const TrainingSet& set,
                                const Candidates& candidates, const LinearFitSettings& settings);

}  // namespace nook::bake
