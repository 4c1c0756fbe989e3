// Draws pictures of a recorded frame and of its replays.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bakers/measure/nnao/frame_comparison.h"
#include "platform/platform.h"

namespace nook::measure {

// Draws the depth. Near pixels are bright and far pixels are dark. The scale is linear in 1 / depth, or in
// depth for orthographic views. It ranges from the 1st to the 99th percentile of the pixels. Pixels without a
// surface are blue.
platform::Image depth_picture(const bake::nnao::TracedView& view);
// Draws the view-space normals n. Red, green and blue are the components of (n + 1) / 2. Pixels without a
// surface are black.
platform::Image normal_picture(const bake::nnao::TracedView& view);
platform::Image ao_picture(std::span<const float> ao, int width, int height);
// Draws the difference of two images, multiplied by 16. A pixel is grey where both are equal, red where `b`
// is darker than `a`, and blue where `b` is brighter.
platform::Image difference_picture(std::span<const float> a, std::span<const float> b, int width, int height);

struct NamedPicture {
  std::string name;  // depth, normals, recorded, replayed, difference, or the name of a method
  platform::Image image;
};
// Returns all pictures of a frame, in the order in which picture_sheet shows them.
std::vector<NamedPicture> frame_pictures(const bake::nnao::TracedView& view, std::span<const FrameRow> rows);

// Arranges the pictures in three columns. All must have the same size.
platform::Image picture_sheet(std::span<const NamedPicture> pictures);

}  // namespace nook::measure
