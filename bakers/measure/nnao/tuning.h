// The grid search that gives each baseline its radius, contrast and shape.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bakers/measure/nnao/baselines.h"
#include "bakers/measure/nnao/measured_view.h"
#include "platform/platform.h"

namespace nook::measure {

struct TunedBaseline {
  BaselineMethod method;
  double mse;  // blurred, mean over the views
};

// Each method from nothing, or from what the search has just found for the same baseline with other taps
// where that is better: radius and contrast together over their grid, then the shape, then to the best
// neighbour of all three until there is none. Tunings that the methods have already do not matter. progress
// counts methods; false stops, which throws Failure(CANCELLED).
std::vector<TunedBaseline> tune_baselines(platform::Context& context, std::span<const MeasuredView> views,
                                          std::span<const BaselineMethod> methods,
                                          const std::function<bool(std::size_t, std::size_t)>& progress);

// A line of baseline_tuning.inl.
std::string tuning_line(const BaselineMethod& method);

}  // namespace nook::measure
