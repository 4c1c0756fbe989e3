// The light that a material reflects as a whole.
#pragma once

#include "sdk/src/core/vec.h"
#include "sdk/src/material/tables.h"

namespace nook::material {

// Returns the share of light that a plane of the material reflects under even light from all directions, RGB:
// the mean over its texels of radiosity over irradiance. The VOTF does not count. Each number is clamped to
// [0, 1], because compression may leave a material of little noise outside.
Vec3 mean_reflectance(const MaterialTables& tables);

}  // namespace nook::material
