// Baked clips of a character as a file.
#pragma once

#include <nook/nook_bake.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bakers/character/clip_tables.h"
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

// Throws Failure(INVALID_ARGUMENT) for a number out of its range or a NULL name.
ClipTask clip_task_of(const nook_bake_clips_desc& desc);

// The frames of the task's clips. Throws what chosen_clips throws, and Failure(INVALID_ARGUMENT) for too many
// frames.
ClipFrames frames_of(const ImportedCharacter& character, const ClipTask& task);

// model and frames are those of the character and the task. The stage is JobStage::raytrace and counts
// frames. Throws Failure: CANCELLED.
BakedFile bake_clips_file(const ImportedCharacter& character, const CharacterModel& model,
                          const ClipFrames& frames, const ClipTask& task, const StageReport& progress);

}  // namespace nook::bake
