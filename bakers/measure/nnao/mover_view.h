// The frames of a body that moves before a scene that stands still, with motion vectors and ray-traced AO.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/measure/nnao/measured_view.h"
#include "bakers/measure/nnao/moving_body.h"

namespace nook::measure {

// The part of the image that a pixel of the last frame belongs to.
enum class MoverPart : std::uint8_t {
  sky,
  mover,      // the body
  uncovered,  // what one of the recent frames shows the body in front of
  beside,     // within the radius of a vertex of the body in the last frame or a recent one: its AO changes
  elsewhere
};
inline constexpr std::size_t mover_part_count = 5;

// Frames before the last that count as recent.
inline constexpr std::size_t recent_frames = 3;

struct MoverView {
  MeasuredView measured;  // the last frame with its reference; its path has the frames before
  // Of each frame, two numbers for each pixel: the pixels by which its surface moved since the frame before,
  // to the right and up. 0 in the first frame and for the sky.
  std::vector<std::vector<float>> motion;
  std::vector<MoverPart> part;  // of each pixel of the last frame
};

// camera: of the last frame. settings: its path may move the camera as well, and has as many frames as the
// body. Throws Failure (INVALID_ARGUMENT) where they differ.
MoverView trace_mover(const bake::TriangleSoup& still, const MovingBody& body,
                      const bake::nnao::Camera& camera, const TruthSettings& settings);

}  // namespace nook::measure
