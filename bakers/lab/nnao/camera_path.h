// Makes a camera path that ends at a given view. Finds where the surfaces of a frame were in the previous
// frame.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/nnao/cameras.h"

namespace nook::lab {

struct PathSettings {
  std::size_t frames = 0;  // number of frames, including the view itself; 0 makes no path
  // How far surfaces at the median depth move sideways, in pixels per frame. The default is not an integer,
  // so that every frame must be resampled.
  float step_px = 2.7f;
  // The camera's forward motion divided by its sideways motion. Because of the forward motion, images must
  // also be resampled vertically.
  float forward = 0.3f;
};

// Returns the cameras of the frames before the view, the oldest first. The path comes from the side that has
// more free space. If a wall is too near, the path is shorter.
std::vector<bake::nnao::Camera> path_cameras(const bake::RayScene& rays, const bake::nnao::TracedView& view,
                                             const PathSettings& settings);

// Returns the G-buffers of these frames.
std::vector<bake::nnao::TracedView> trace_path(const bake::RayScene& rays, const bake::nnao::TracedView& view,
                                               const PathSettings& settings);

// Returns the matrix from the view space of a frame to the view space of the frame before.
Mat3x4 earlier_from_view(const bake::nnao::Camera& now, const bake::nnao::Camera& before);

// The position of a point in a camera's image, in pixels from the centre of the lower left pixel.
struct ScreenPlace {
  float x = 0, y = 0;
  // True if the point is in front of the camera and at most one pixel outside the image.
  bool in_image = false;
};
ScreenPlace screen_place(const bake::nnao::Camera& camera, Vec3 position_vs);

// The pixels of the previous frame that show the same surface as a pixel of this frame. The four pixels
// around the surface's position in the previous frame are tested, and those with matching depth are used.
// Their weights are bilinear and scaled to sum to 1. If the surface was hidden or outside the image, all
// weights are 0.
struct EarlierPixels {
  std::array<std::uint32_t, 4> pixel{};
  std::array<float, 4> weight{};

  bool seen() const { return weight[0] + weight[1] + weight[2] + weight[3] > 0; }
};

// Returns one entry for each pixel of `now`. The entry of a pixel without a surface is empty.
std::vector<EarlierPixels> earlier_pixels(const bake::nnao::TracedView& now,
                                          const bake::nnao::TracedView& before);

}  // namespace nook::lab
