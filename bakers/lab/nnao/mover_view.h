// The frames of a body that moves before a scene that stands still, with motion vectors and ray-traced AO.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bakers/import/gltf.h"
#include "bakers/lab/nnao/measured_view.h"

namespace nook::lab {

// A skinned character that walks: the place of its surface in each frame of a sequence.
struct MovingBody {
  std::vector<std::array<std::uint32_t, 3>> triangle;
  std::vector<std::vector<Vec3>> position;  // of each frame's vertices, the oldest first; world space, metres
};

struct WalkSettings {
  std::size_t frames = 8;
  float frame_s = 1.0f / 30;  // seconds from frame to frame
  float phase = 0;  // of the clip, 0 to 1: the sequence lies there, and ends at the clip's end where it is 1
  float heading = 0;       // turns the body, which looks along +z, about the vertical axis; radians
  float speed_mps = 1.4f;  // along its heading, metres a second
};

// Poses the character by its clip. In the last frame its origin is the world's.
MovingBody walking_body(const bake::ImportedCharacter& character, std::size_t clip,
                        const WalkSettings& settings);

// Returns the clip of this name; empty: the first whose name has `walk` in it, in either case, or else the
// first one. Throws Failure: INVALID_ARGUMENT with the names there are, BAD_FILE without any clip.
std::size_t walking_clip(const bake::ImportedCharacter& character, const std::string& name);

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

}  // namespace nook::lab
