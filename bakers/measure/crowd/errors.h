// Errors of values at vertices against their reference.
#pragma once

#include "bakers/measure/crowd/posed_crowd.h"

namespace nook::measure::crowd {

struct Errors {
  double mse = 0;  // mean over vertices
  // Of AO: the mean over vertices whose reference is at least visible_truth, 0 where there are none.
  double mse_visible = 0;
  double mse_area = 0;  // each vertex weighted by its area of the posed surface
};

// The errors over all receivers. Each vertex has `channels` values, and errors are in units of `unit`.
// Vertices that no triangle uses count nothing. Values of one channel are AO.
Errors compare(const PosedCrowd& crowd, std::span<const std::uint32_t> receivers, const VertexValues& values,
               const VertexValues& reference, std::uint32_t channels = 1, float unit = 1);

}  // namespace nook::measure::crowd
