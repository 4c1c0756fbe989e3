// The check of a set of clips. A set that passes can be evaluated without further checks.
#pragma once

#include <nook/nook.h>

#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/model.h"

namespace nook {

// Throws Failure with `code` and the first fault: a count or an index is out of range, an array has the wrong
// length, or a number is not finite or is outside its range.
void check_clip_set(const ClipSet& set, nook_result code);
// The same for the counts alone, before an array is read.
void check_clip_counts(const ClipSet& set, nook_result code);

// The hash of what a set takes from the model: the order of welded vertices and bones. A new bake of the same
// character keeps it, and so does a model in the order of a host's mesh.
std::uint64_t clip_model_hash(const CharacterModel& model);

// Throws Failure(INVALID_ARGUMENT) unless the set was baked from the character of the model.
void check_clip_model(const ClipSet& set, const CharacterModel& model);

}  // namespace nook
