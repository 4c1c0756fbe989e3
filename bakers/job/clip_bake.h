// Baked clips of a character as a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bakers/character/clip_bake.h"
#include "bakers/job/baked_file.h"

namespace nook::bake {

struct ClipTask {
  std::vector<std::string> clips;  // empty: all but T- and A-poses
  double frames_per_second = 30;
  std::uint32_t rays = 128;
  ClipTableSettings tables;  // its seed is that of the rays as well
};

// The clips in byte order of their names. Throws Failure(INVALID_ARGUMENT) for a name that the character does
// not have, or where it has no clip.
std::vector<std::size_t> chosen_clips(const ImportedCharacter& character, std::span<const std::string> names);

// The model is that of the character. The stage is NOOK_BAKE_STAGE_RAYTRACE and counts frames. Throws
// Failure: BAD_FILE (no model, or that of another character), INVALID_ARGUMENT, CANCELLED.
BakedFile bake_clips_file(const ImportedCharacter& character, std::span<const std::byte> model_bytes,
                          const ClipTask& task, const StageReport& progress);

}  // namespace nook::bake
