// The maximum distance of geometry from the origin.
#pragma once

#include <cmath>

#include "sdk/src/core/vec.h"

namespace nook {

// Metres along each axis. A float's step is 6 cm at the bound, so that neither a character nor a scene makes
// sense beyond it, and every later product of coordinates stays finite.
constexpr float max_metres = 1e6f;

// False for what is not finite.
inline bool is_place(Vec3 p) {
  return std::abs(p.x) <= max_metres && std::abs(p.y) <= max_metres && std::abs(p.z) <= max_metres;
}

}  // namespace nook
