// Reads the descriptor of a pose.
#pragma once

#include <nook/nook_character.h>

#include "sdk/src/character/pose_source.h"

namespace nook::api {

// Throws Failure for a descriptor that is wrong whatever its transforms are; check_pose_source checks the
// rest.
PoseSource source_of(const CharacterModel& model, const nook_pose_desc* given);

}  // namespace nook::api
