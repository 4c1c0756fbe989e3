// Bakes clips of a character to a file.
#pragma once

#include <nook/nook_bake.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bakers/character/clip_tables.h"
#include "bakers/job/bake_identity.h"
#include "bakers/job/baked_file.h"

namespace nook::bake {

struct ClipTask {
  std::vector<std::string> clips;  // empty: all clips except T-poses and A-poses
  double frames_per_second = 30;
  std::uint32_t rays = 128;
  ClipTableSettings tables;  // tables.seed is also the random seed of the rays
};

// Returns the indices of the chosen clips, sorted by the bytes of their names. Throws
// Failure(INVALID_ARGUMENT) if the character has no clip with one of the names, or no clips at all.
std::vector<std::size_t> chosen_clips(const ImportedCharacter& character, std::span<const std::string> names);

// Throws Failure(INVALID_ARGUMENT) for a number out of its range or a NULL name.
ClipTask clip_task_of(const nook_bake_clips_desc& desc);

// Returns the frames of the task's clips. Throws what chosen_clips throws, and Failure(INVALID_ARGUMENT) for
// too many frames.
ClipFrames frames_of(const ImportedCharacter& character, const ClipTask& task);

// Returns the identity of a call of bake_clips_file for the model in these bytes. Throws what chosen_clips
// throws.
BakeIdentity identify_clips(const ImportedCharacter& character, std::span<const std::byte> model_bytes,
                            const ClipTask& task);

// `model` must be the model of the character, and `frames` must be the frames of the task. If `identity` is
// not empty, the file stores it. Progress reports the stage JobStage::raytrace and counts frames. Throws
// Failure: CANCELLED.
BakedFile bake_clips_file(const ImportedCharacter& character, const CharacterModel& model,
                          const ClipFrames& frames, const ClipTask& task, const StageReport& progress,
                          const BakeIdentity& identity = {});

}  // namespace nook::bake
