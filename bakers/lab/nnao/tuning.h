// Finds radius, contrast, shape, border and denoiser for each baseline.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bakers/lab/nnao/measured_view.h"
#include "bakers/lab/nnao/screen_baselines.h"
#include "platform/platform.h"

namespace nook::lab {

// Number of parameters that the search varies.
inline constexpr std::size_t tuned_axes = 4;  // radius_scale, power, shape, thin
inline constexpr std::array<const char*, tuned_axes> axis_names{"radius_scale", "power", "shape", "thin"};

// A tuning as places on the grids.
struct TuningPlace {
  std::array<int, tuned_axes> at{};
  bool equal_weights = false;
  Border border = Border::nothing;
  Denoiser denoiser = Denoiser::blur;

  auto operator<=>(const TuningPlace&) const = default;
};

// Returns the values of an axis, growing; one value if the baseline has no such parameter.
std::span<const float> axis_values(Baseline baseline, std::size_t axis);

BaselineTuning tuning_at(Baseline baseline, const TuningPlace& place);

// Returns the radius and contrast of the request, the middle of the shapes, and a denoiser that is fast to
// draw.
TuningPlace first_place(Baseline baseline);

// Returns the axes on which a place is at the end of a grid that could be longer. A bias or a compensation
// cannot be below 0, and XeGTAO's falloff goes from nearly nothing to the whole radius.
std::vector<std::string> axes_at_edge(Baseline baseline, const TuningPlace& place);

struct TunedBaseline {
  BaselineMethod method;
  double mse;  // denoised, mean over the views
  // Parameters whose best value is at the end of a grid that could be longer: the grid is too small.
  std::vector<std::string> at_edge;
};

// Tunes each method from nothing, or from the result for the same baseline with other taps. It goes down the
// grids in shrinking strides, on a third of the views and then on all. It tries borders and sectors, and
// tunes radius and contrast for each denoiser. Tunings that the methods have already do not matter. progress
// counts methods; false stops, which throws Failure(CANCELLED).
std::vector<TunedBaseline> tune_baselines(platform::Context& context, std::span<const MeasuredView> views,
                                          std::span<const BaselineMethod> methods,
                                          const std::function<bool(std::size_t, std::size_t)>& progress);

// Returns a line of baseline_tuning.inl.
std::string tuning_line(const BaselineMethod& method);

}  // namespace nook::lab
