// The check of a character model. A model that passes can be evaluated without further checks.
#pragma once

#include <nook/nook.h>

#include "sdk/src/character/model.h"

namespace nook {

// The bound of alpha, bias and caster weight. It is far above fitted values, unless the spheres are far too
// small.
constexpr float max_coefficient = 1e4f;

// With more, a key point is a switch: half of its shadow's range lies below a norm of 1/64.
constexpr float max_saturation = 64;

// Throws Failure with `code` and the first fault: a count or an index is out of range, a number is not finite
// or is outside its range, or weights do not sum to one.
void check_model(const CharacterModel& model, nook_result code);

}  // namespace nook
