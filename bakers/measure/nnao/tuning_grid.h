// The values that the search tries for each parameter of a baseline.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "bakers/measure/nnao/baselines.h"

namespace nook::measure {

inline constexpr std::size_t tuned_axes = 4;  // radius_scale, power, shape, thin
inline constexpr std::array<const char*, tuned_axes> axis_names{"radius_scale", "power", "shape", "thin"};

// A tuning by its places on the grids.
struct TuningPlace {
  std::array<int, tuned_axes> at{};
  bool equal_weights = false;
  Border border = Border::nothing;
  Denoiser denoiser = Denoiser::blur;

  auto operator<=>(const TuningPlace&) const = default;
};

// Returns the values of an axis, growing; one where the baseline has no such parameter.
std::span<const float> axis_values(Baseline baseline, std::size_t axis);

BaselineTuning tuning_at(Baseline baseline, const TuningPlace& place);

// Radius and contrast of the request, the middle of the shapes, a denoiser that is soon drawn.
TuningPlace first_place(Baseline baseline);

// Returns the axes on which a place is the last of a grid that could go on. A bias or a compensation cannot
// be below 0, and XeGTAO's falloff takes from nearly nothing to the whole radius.
std::vector<std::string> axes_at_edge(Baseline baseline, const TuningPlace& place);

}  // namespace nook::measure
