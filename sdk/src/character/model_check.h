// Is a character model sound? Whatever passes can be evaluated without further checks.
#pragma once

#include <nook/nook.h>

#include "sdk/src/character/model.h"

namespace nook {

// Of alpha, bias and caster weight: far above what a fit gives, but where the spheres are far too small.
constexpr float max_coefficient = 1e4f;

// Throws Failure with `code` and the first fault found: a count out of bounds, an index out of range, a
// number that is not finite or outside its range, weights that do not sum to one.
void check_model(const CharacterModel& model, nook_result code);

}  // namespace nook
