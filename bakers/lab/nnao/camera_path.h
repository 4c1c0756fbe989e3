// A camera that moves to a view, and where the surfaces of a frame lay in the frame before.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/nnao/cameras.h"

namespace nook::lab {

struct PathSettings {
  std::size_t frames = 0;  // with the view itself; 0: no path
  // Pixels by which surfaces at the median depth move sideways in a frame. Not a whole number, so that every
  // frame is resampled.
  float step_px = 2.7f;
  // The way forward over the way sideways, so that rows are resampled as well.
  float forward = 0.3f;
};

// Returns the cameras of the frames before the view, the oldest first. The camera comes from the side with
// more room, and its way is shorter where the room ends.
std::vector<bake::nnao::Camera> path_cameras(const bake::RayScene& rays, const bake::nnao::TracedView& view,
                                             const PathSettings& settings);

// The G-buffers of these frames.
std::vector<bake::nnao::TracedView> trace_path(const bake::RayScene& rays, const bake::nnao::TracedView& view,
                                               const PathSettings& settings);

// From the view space of a frame to that of the frame before.
Mat3x4 earlier_from_view(const bake::nnao::Camera& now, const bake::nnao::Camera& before);

// Where a camera shows a point, in pixels from the lower left pixel's centre.
struct ScreenPlace {
  float x = 0, y = 0;
  bool in_image = false;  // within a pixel's width of a pixel's centre, and before the camera
};
ScreenPlace screen_place(const bake::nnao::Camera& camera, Vec3 position_vs);

// The pixels of the frame before that show a pixel's surface: those of the four around its place there whose
// depth is that of the surface. The weights are bilinear and sum to 1, or all are 0 where the surface was
// hidden or outside the image.
struct EarlierPixels {
  std::array<std::uint32_t, 4> pixel{};
  std::array<float, 4> weight{};

  bool seen() const { return weight[0] + weight[1] + weight[2] + weight[3] > 0; }
};

// One for each pixel of `now`; without a surface nothing was seen.
std::vector<EarlierPixels> earlier_pixels(const bake::nnao::TracedView& now,
                                          const bake::nnao::TracedView& before);

}  // namespace nook::lab
