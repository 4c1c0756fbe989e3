// Evenly spread directions for the axes of lobes.
#pragma once

#include <span>

#include "sdk/src/core/vec.h"

namespace nook::probe {

// H. Vogel's spiral: azimuths apart by the golden angle, heights at the centres of equal areas. Over the
// whole sphere round +z, or the hemisphere round `up`.
void vogel_sphere(std::span<Vec3> axes);
void vogel_hemisphere(Vec3 up, std::span<Vec3> axes);

// Two unit vectors across a unit vector, right-handed with it as third axis.
struct Frame {
  Vec3 x, y, z;
};
Frame frame_round(Vec3 z);

}  // namespace nook::probe
