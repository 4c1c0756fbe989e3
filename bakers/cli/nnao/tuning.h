// The grid search that gives each peer its radius, contrast and shape.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cli/nnao/measured_view.h"
#include "cli/nnao/peers.h"
#include "platform/platform.h"

namespace nook::cli {

struct TunedPeer {
  PeerMethod method;
  double mse;  // blurred, mean over the views
};

// Each method from nothing, or from what the search has just found for the same peer with other taps where
// that is better: radius and contrast together over their grid, then the shape, then to the best neighbour of
// all three until there is none. Tunings that the methods have already do not matter. progress counts
// methods; false stops, which throws Failure(CANCELLED).
std::vector<TunedPeer> tune_peers(platform::Context& context, std::span<const MeasuredView> views,
                                  std::span<const PeerMethod> methods,
                                  const std::function<bool(std::size_t, std::size_t)>& progress);

// A line of peer_tuning.inl.
std::string tuning_line(const PeerMethod& method);

}  // namespace nook::cli
