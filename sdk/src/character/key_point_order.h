// The order of key points in the runtime: groups of key_point_group that are near each other, so that one
// decision about a far part of the body serves a whole group.
#pragma once

#include "sdk/src/character/model.h"

namespace nook {

// Renumbers the key points of a model that has passed check_model. What the model means stays the same.
CharacterModel with_near_key_points_together(CharacterModel model, Memory* memory);

}  // namespace nook
