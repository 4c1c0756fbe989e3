// Makes frames of a body that moves in a static scene, with motion vectors and ray-traced AO.
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
  // Position of the sequence in the clip, 0 to 1; at 1, the sequence ends together with the clip.
  float phase = 0;
  float heading = 0;       // rotation about the vertical axis, radians; at 0 the body looks along +z
  float speed_mps = 1.4f;  // walking speed along the heading, metres per second
};

// Poses the character by the clip and moves it along its heading. In the last frame, it is at the origin of
// the world.
MovingBody walking_body(const bake::ImportedCharacter& character, std::size_t clip,
                        const WalkSettings& settings);

// Returns the index of the clip with this name. If `name` is empty, returns the first clip whose name
// contains `walk` (case-insensitive), or the first clip if there is none. Throws Failure: INVALID_ARGUMENT,
// with the existing names, if no clip has the name, and BAD_FILE if the character has no clips.
std::size_t walking_clip(const bake::ImportedCharacter& character, const std::string& name);

// The part of the image to which a pixel of the last frame belongs.
enum class MoverPart : std::uint8_t {
  sky,
  mover,      // the body
  uncovered,  // the body hid this surface in a recent frame
  beside,     // the body is within the AO radius in this frame or was in a recent one, so the AO changes
  elsewhere
};
inline constexpr std::size_t mover_part_count = 5;

// The number of frames before the last one that count as recent.
inline constexpr std::size_t recent_frames = 3;

struct MoverView {
  MeasuredView measured;  // the last frame with its reference; the earlier frames are its path
  // The motion vectors of each frame. Each pixel has two values: how far its surface has moved since the
  // previous frame, in pixels to the right and in pixels up. Both values are 0 in the first frame and for the
  // sky.
  std::vector<std::vector<float>> motion;
  std::vector<MoverPart> part;  // for each pixel of the last frame
};

// `camera` is the camera of the last frame. The path in `settings` may move the camera as well. The path must
// have as many frames as the body; otherwise throws Failure (INVALID_ARGUMENT).
MoverView trace_mover(const bake::TriangleSoup& still, const MovingBody& body,
                      const bake::nnao::Camera& camera, const TruthSettings& settings);

}  // namespace nook::lab
