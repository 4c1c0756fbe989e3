// Searches for the best radius, contrast, shape, border and denoiser of each baseline.
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

// A tuning, stored as indices into the grids of values.
struct TuningPlace {
  std::array<int, tuned_axes> at{};
  bool equal_weights = false;
  Border border = Border::nothing;
  Denoiser denoiser = Denoiser::blur;

  auto operator<=>(const TuningPlace&) const = default;
};

// Returns the values of an axis in ascending order. If the baseline does not have the parameter, returns one
// value.
std::span<const float> axis_values(Baseline baseline, std::size_t axis);

BaselineTuning tuning_at(Baseline baseline, const TuningPlace& place);

// Returns the place at which the search starts. It has the radius and contrast of the request, the middle
// value of the shape, and a fast denoiser.
TuningPlace first_place(Baseline baseline);

// Returns the axes on which the place is at the end of its grid, if the grid could be extended there. Ends
// that are natural limits do not count. A bias or compensation cannot be below 0, and XeGTAO's falloff
// already ranges from almost 0 to the whole radius.
std::vector<std::string> axes_at_edge(Baseline baseline, const TuningPlace& place);

struct TunedBaseline {
  BaselineMethod method;
  double mse;  // error after denoising; mean over the views
  // Parameters whose best value is at the end of a grid that could be extended. For these parameters, the
  // grid is too small.
  std::vector<std::string> at_edge;
};

// Tunes each method. The search starts from first_place, and from the results of the same baseline with other
// numbers of taps. It moves along the grids with shrinking strides, first on a third of the views and then on
// all views. It also tries the borders and sectors, and tunes radius and contrast for each denoiser. Existing
// tunings of the methods are ignored. `progress` counts methods. If it returns false, the function throws
// Failure(CANCELLED).
std::vector<TunedBaseline> tune_baselines(platform::Context& context, std::span<const MeasuredView> views,
                                          std::span<const BaselineMethod> methods,
                                          const std::function<bool(std::size_t, std::size_t)>& progress);

// Returns the method's line for baseline_tuning.inl.
std::string tuning_line(const BaselineMethod& method);

}  // namespace nook::lab
