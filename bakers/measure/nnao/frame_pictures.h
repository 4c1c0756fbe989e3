// Draws a recorded frame and its replays.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bakers/measure/nnao/frame_comparison.h"
#include "platform/platform.h"

namespace nook::measure {

// Near is bright and far is dark. The scale is linear in 1 / depth (for orthographic views, in depth) between
// the 1st and the 99th percentile of the pixels. Pixels without a surface are blue.
platform::Image depth_picture(const bake::nnao::TracedView& view);
// Red, green and blue are (n + 1) / 2 in view space. Pixels without a surface are black.
platform::Image normal_picture(const bake::nnao::TracedView& view);
platform::Image ao_picture(std::span<const float> ao, int width, int height);
// Grey means equal. Red means that `b` is darker than `a`, blue that `b` is brighter. The difference is
// multiplied by 16.
platform::Image difference_picture(std::span<const float> a, std::span<const float> b, int width, int height);

struct NamedPicture {
  std::string name;  // depth, normals, recorded, replayed, difference, or the name of a method
  platform::Image image;
};
// Returns all pictures of a frame in the order in which a sheet shows them.
std::vector<NamedPicture> frame_pictures(const bake::nnao::TracedView& view, std::span<const FrameRow> rows);

// Arranges the pictures in three columns. All must have the same size.
platform::Image picture_sheet(std::span<const NamedPicture> pictures);

}  // namespace nook::measure
