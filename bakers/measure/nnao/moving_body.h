// A skinned character that walks: the place of its surface in each frame of a sequence.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bakers/import/gltf.h"

namespace nook::measure {

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

}  // namespace nook::measure
