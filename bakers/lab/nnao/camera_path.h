// Moves a camera to a view, and finds where the surfaces of a frame were in the frame before.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/nnao/cameras.h"

namespace nook::lab {

struct PathSettings {
  std::size_t frames = 0;  // includes the view itself; 0: no path
  // Pixels by which surfaces at the median depth move sideways per frame. It is not a whole number, so that
  // every frame is resampled.
  float step_px = 2.7f;
  // Forward motion over sideways motion, so that rows are resampled as well.
  float forward = 0.3f;
};

// Returns the cameras of the frames before the view, the oldest first. The camera comes from the side with
// more room. Its way is shorter where the room ends.
std::vector<bake::nnao::Camera> path_cameras(const bake::RayScene& rays, const bake::nnao::TracedView& view,
                                             const PathSettings& settings);

// Returns the G-buffers of these frames.
std::vector<bake::nnao::TracedView> trace_path(const bake::RayScene& rays, const bake::nnao::TracedView& view,
                                               const PathSettings& settings);

// Returns the matrix from the view space of a frame to the view space of the frame before.
Mat3x4 earlier_from_view(const bake::nnao::Camera& now, const bake::nnao::Camera& before);

// Where a camera sees a point, in pixels from the lower left pixel's centre.
struct ScreenPlace {
  float x = 0, y = 0;
  bool in_image = false;  // at most one pixel outside, and in front of the camera
};
ScreenPlace screen_place(const bake::nnao::Camera& camera, Vec3 position_vs);

// The pixels of the frame before that show a pixel's surface: of the four around its place there, those with
// the surface's depth. The weights are bilinear and sum to 1. They are all 0 if the surface was hidden or
// outside the image.
struct EarlierPixels {
  std::array<std::uint32_t, 4> pixel{};
  std::array<float, 4> weight{};

  bool seen() const { return weight[0] + weight[1] + weight[2] + weight[3] > 0; }
};

// Returns one entry for each pixel of `now`, which is empty without a surface.
std::vector<EarlierPixels> earlier_pixels(const bake::nnao::TracedView& now,
                                          const bake::nnao::TracedView& before);

}  // namespace nook::lab
