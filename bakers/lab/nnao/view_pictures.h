// Draws one view by several methods, and shows what a network has learned.
#pragma once

#include <span>
#include <vector>

#include "bakers/lab/nnao/measured_view.h"
#include "platform/platform.h"
#include "sdk/src/nnao/network.h"

namespace nook::lab {

// Draws the results of methods for one view beside the truth, in three columns. Row by row from the upper
// left, it shows the scene lit from the camera, the ray-traced AO, then each image. Images have as many
// pixels as the view, rows from the bottom.
platform::Image make_sheet(const MeasuredView& measured, std::span<const std::vector<float>> images);

// Draws the first layer: white where it adds to a unit and black where it subtracts. For the paper's form, a
// row of 31 x 31 filters belongs to each of the inputs n_x, n_y, n_z and depth, and a column to each unit.
// For the horizon form, it draws the answer of each of the eight units to a tap. The tap is 0 to 2 radii away
// (left to right), and from straight below to straight above the tangent plane (upwards). The view is at
// right angles to the viewer's direction.
platform::Image filter_picture(const nook::nnao::Network& network);

// Draws nook::nnao::first_units over a view as cyan, magenta and yellow. Each goes from the 1st to the 99th
// percentile of its pixels. Pixels without a surface are white.
platform::Image unit_picture(const nook::nnao::Network& network, const MeasuredView& view);

}  // namespace nook::lab
