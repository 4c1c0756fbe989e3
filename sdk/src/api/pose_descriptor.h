// Reads the descriptor of a pose.
#pragma once

#include <nook/nook_character.h>

#include "sdk/src/character/pose_source.h"

namespace nook::api {

// Converts the caller's descriptor. Throws Failure for invalid fields, without reading the transforms.
// check_pose_source makes all other checks.
PoseSource source_of(const CharacterModel& model, const nook_pose_desc* given);

}  // namespace nook::api
