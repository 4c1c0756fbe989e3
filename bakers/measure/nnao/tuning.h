// The search that gives each baseline its radius, contrast, shape, border and denoiser.
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
  double mse;  // denoised, mean over the views
  // Parameters whose best value is the last one of a grid that could go on: the grid is too small.
  std::vector<std::string> at_edge;
};

// Each method from nothing, or from what the search has just found for the same baseline with other taps:
// down the grids in strides that shrink, on a third of the views and then on all; borders and sectors by
// trial; each denoiser with a radius and a contrast of its own. Tunings that the methods have already do not
// matter. progress counts methods; false stops, which throws Failure(CANCELLED).
std::vector<TunedBaseline> tune_baselines(platform::Context& context, std::span<const MeasuredView> views,
                                          std::span<const BaselineMethod> methods,
                                          const std::function<bool(std::size_t, std::size_t)>& progress);

// A line of baseline_tuning.inl.
std::string tuning_line(const BaselineMethod& method);

}  // namespace nook::measure
