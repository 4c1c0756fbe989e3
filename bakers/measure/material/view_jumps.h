// The jumps of a decoded material while the view moves slowly, which the paper's Figures 1 and 2 show for
// CTA.
#pragma once

#include <cstdint>

#include "sdk/src/material/material.h"

namespace nook::bake::material {

inline constexpr float jump_step_deg = 0.1f;

struct ViewJumps {
  // The change of the radiances of all lights over a step of the view, as the root of the mean square over
  // texels, relative to the radiances themselves: the largest of all steps, and the 99th percentile.
  double largest = 0, percentile_99 = 0;
  Vec3 before, after;  // the views of the largest
};

// Moves the view along 64 random arcs of 6 degrees, no more than 70 degrees from the normal, and decodes as
// the runtime does, on a grid of up to 16 x 16 texels.
ViewJumps measure_view_jumps(const nook::material::Material& material, std::uint64_t seed);

}  // namespace nook::bake::material
