// Sets of light and view directions. Tile space: x and y along the surface, z out of it; a direction points
// away from the surface, to the light or to the viewer, and has unit length.
#pragma once

#include <cstdint>
#include <vector>

#include "sdk/src/core/vec.h"

namespace nook::bake::material {

// Measured and simulated sets end here: beyond it a texel's footprint says little of the structure.
inline constexpr float default_max_tilt_deg = 75;

// `count` directions on a spiral from the normal down to max_tilt_deg, each of about the same solid angle.
// Throws Failure(INVALID_ARGUMENT) unless count >= 4 and 0 < max_tilt_deg < 90.
std::vector<Vec3> spiral_directions(std::uint32_t count, float max_tilt_deg = default_max_tilt_deg);

// From tilt (against the normal) and azimuth (from x towards y), degrees.
Vec3 direction_from_angles(float tilt_deg, float azimuth_deg);

}  // namespace nook::bake::material
