// Pictures to look at: what methods make of one view, beside the truth.
#pragma once

#include <span>
#include <vector>

#include "bakers/measure/nnao/measured_view.h"
#include "platform/platform.h"

namespace nook::measure {

// Three columns; row by row from the upper left: the scene lit from the camera, the ray-traced AO, then each
// image. Images have as many pixels as the view, rows from the bottom.
platform::Image make_sheet(const MeasuredView& measured, std::span<const std::vector<float>> images);

}  // namespace nook::measure
