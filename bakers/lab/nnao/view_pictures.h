// Makes pictures that compare methods on one view, or that show what a network has learned.
#pragma once

#include <span>
#include <vector>

#include "bakers/lab/nnao/measured_view.h"
#include "platform/platform.h"
#include "sdk/src/nnao/network.h"

namespace nook::lab {

// Puts the AO images of several methods beside the reference, in three columns. Starting at the upper left,
// the panels show the scene lit from the camera, the ray-traced AO, and then each image. `images` must have
// the size of the view, with rows from the bottom.
platform::Image make_sheet(const MeasuredView& measured, std::span<const std::vector<float>> images);

// Draws the weights of the first layer. Positive weights are white, and negative weights are black. For the
// paper's form, the picture is a table of 31 x 31 filters: each row is one of the inputs n_x, n_y, n_z and
// depth, and each column is a unit. For the horizon form, the picture shows the response of each of the eight
// units to one tap. The distance of the tap grows from 0 to 2 radii from left to right. Its elevation grows
// upwards, from straight below the tangent plane to straight above it. The taps lie in a plane at right
// angles to the viewing direction.
platform::Image filter_picture(const nook::nnao::Network& network);

// Draws the outputs of nook::nnao::first_units for a view as cyan, magenta and yellow. Each colour is scaled
// to the range from the 1st to the 99th percentile of its unit. Pixels without a surface are white.
platform::Image unit_picture(const nook::nnao::Network& network, const MeasuredView& view);

}  // namespace nook::lab
