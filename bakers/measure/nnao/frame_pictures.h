// Pictures of a recorded frame and of its replays.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bakers/measure/nnao/frame_comparison.h"
#include "platform/platform.h"

namespace nook::measure {

// Near is bright and far is dark, evenly in 1 / depth (orthographic: in depth) between the hundredth part of
// the pixels and its ninety-nine hundredths; no surface is blue.
platform::Image depth_picture(const bake::nnao::TracedView& view);
// (n + 1) / 2 of view space in red, green and blue; no surface is black.
platform::Image normal_picture(const bake::nnao::TracedView& view);
platform::Image ao_picture(std::span<const float> ao, int width, int height);
// Grey where both agree; red where b is darker than a, blue where it is brighter, 16 times as strongly.
platform::Image difference_picture(std::span<const float> a, std::span<const float> b, int width, int height);

struct NamedPicture {
  std::string name;  // depth, normals, recorded, replayed, difference, the methods' names
  platform::Image image;
};
// All pictures of a frame in the order in which a sheet shows them.
std::vector<NamedPicture> frame_pictures(const bake::nnao::TracedView& view, std::span<const FrameRow> rows);

// The pictures, which have one size, in three columns.
platform::Image picture_sheet(std::span<const NamedPicture> pictures);

}  // namespace nook::measure
