// Is a character model sound? Whatever passes can be evaluated without further checks.
#pragma once

#include <nook/nook.h>

#include "sdk/src/character/model.h"

namespace nook {

// Throws Failure with `code` and the first fault found: a count out of bounds, an index out of range, a
// number that is not finite or outside its range, weights that do not sum to one.
void check_model(const CharacterModel& model, nook_result code);

}  // namespace nook
