// Pictures to look at: what methods make of one view, and what a network has learned.
#pragma once

#include <span>
#include <vector>

#include "bakers/lab/nnao/measured_view.h"
#include "platform/platform.h"
#include "sdk/src/nnao/network.h"

namespace nook::lab {

// The results of methods for one view, beside the truth. Three columns; row by row from the upper left: the
// scene lit from the camera, the ray-traced AO, then each image. Images have as many pixels as the view, rows
// from the bottom.
platform::Image make_sheet(const MeasuredView& measured, std::span<const std::vector<float>> images);

// The first layer, white where it adds to a unit and black where it takes away. The paper's form: one row of
// 31 x 31 filters for each of the inputs n_x, n_y, n_z and depth, a column for each unit. The horizon form:
// the answer of each of the eight units to a tap, from 0 to 2 radii away (left to right) and from straight
// below to straight above the tangent plane (upwards), seen at right angles to the way to the viewer.
platform::Image filter_picture(const nook::nnao::Network& network);

// nook::nnao::first_units over a view as its cyan, magenta and yellow, each from its hundredth part of
// pixels to its ninety-nine hundredths; white without a surface.
platform::Image unit_picture(const nook::nnao::Network& network, const MeasuredView& view);

}  // namespace nook::lab
