// Frames of a body that moves in a still scene, with motion vectors and ray-traced AO.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bakers/import/gltf.h"
#include "bakers/lab/nnao/measured_view.h"

namespace nook::lab {

// A walking skinned character and its surface in each frame.
struct MovingBody {
  std::vector<std::array<std::uint32_t, 3>> triangle;
  std::vector<std::vector<Vec3>> position;  // vertices of each frame, the oldest first; world space, metres
};

struct WalkSettings {
  std::size_t frames = 8;
  float frame_s = 1.0f / 30;  // seconds between frames
  float phase = 0;            // place of the sequence in the clip, 0 to 1; at 1 it ends with the clip
  float heading = 0;          // turns the body, which looks along +z, about the vertical axis; radians
  float speed_mps = 1.4f;     // along its heading, metres per second
};

// Poses the character by its clip. In the last frame, it stands at the world's origin.
MovingBody walking_body(const bake::ImportedCharacter& character, std::size_t clip,
                        const WalkSettings& settings);

// Returns the clip with this name. empty: the first clip whose name contains `walk`, in either case, or else
// the first clip. Throws Failure: INVALID_ARGUMENT with the existing names, BAD_FILE without any clip.
std::size_t walking_clip(const bake::ImportedCharacter& character, const std::string& name);

// The part of the image to which a pixel of the last frame belongs.
enum class MoverPart : std::uint8_t {
  sky,
  mover,      // the body
  uncovered,  // hidden by the body in a recent frame
  beside,     // within the radius of a vertex of the body in this or a recent frame, so that its AO changes
  elsewhere
};
inline constexpr std::size_t mover_part_count = 5;

// Frames before the last that count as recent.
inline constexpr std::size_t recent_frames = 3;

struct MoverView {
  MeasuredView measured;  // the last frame with its reference, and the frames before as its path
  // For each frame and pixel: how far its surface moved since the frame before, in pixels to the right and
  // up. The values are 0 in the first frame and for the sky.
  std::vector<std::vector<float>> motion;
  std::vector<MoverPart> part;  // for each pixel of the last frame
};

// camera: for the last frame. settings: its path may move the camera as well, and must have as many frames as
// the body. Throws Failure (INVALID_ARGUMENT) otherwise.
MoverView trace_mover(const bake::TriangleSoup& still, const MovingBody& body,
                      const bake::nnao::Camera& camera, const TruthSettings& settings);

}  // namespace nook::lab
