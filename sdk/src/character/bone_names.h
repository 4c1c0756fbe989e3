// Finds a host's transforms by the names of bones.
#pragma once

#include <nook/nook_character.h>

#include <cstdint>
#include <span>

#include "sdk/src/character/model.h"
#include "sdk/src/core/memory.h"

namespace nook {

// Writes the index of the first of the host's names that matches each bone, or -1, and returns the number of
// -1. Bones of one joint take the transform of its first bone where their own name has none.
std::size_t map_bones(const CharacterModel& model, const nook_bone_map_desc& names,
                      std::span<std::int32_t> transform_of_bone, Memory* memory);

}  // namespace nook
