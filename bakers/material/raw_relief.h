// Finds the relief of a raw material, and moves its views onto the points of that relief; see Relief in sdk's
// material/material.h.
#pragma once

#include <cstddef>
#include <vector>

#include "bakers/material/periodic_tile.h"
#include "bakers/material/raw_material.h"
#include "bakers/material/tile_heights.h"
#include "sdk/src/material/material.h"

namespace nook::bake::material {

inline constexpr std::uint32_t default_relief_steps = 8;

// Makes the relief of heights over z = 0 in tiles, texel x * height + y. It serves view angles up to the
// steepest of the raw material, at most 80 degrees. `steps` is for the march; 0: a plane at the heights'
// mean.
nook::material::Relief relief_of_heights(const RawMaterial& raw, const std::vector<float>& heights,
                                         std::uint32_t steps = default_relief_steps);

// Throws Failure(INVALID_ARGUMENT) if the raw material's heights are not known, are not as many as texels, or
// exceed the limits of a file.
void check_heights(const RawMaterial& raw);

// Estimates the heights that the views agree on. Candidates are these heights smoothed over several lengths,
// a plane at their mean, and no relief at all. Returns the candidate that predicts views of the raw material
// best from other views. With fewer than 8 views there is no relief.
nook::material::Relief estimate_relief(const RawMaterial& raw, const ReliefProgress& progress = {});

// The same for the raw material's own heights, which are a candidate without smoothing too. Throws what
// check_heights() throws.
nook::material::Relief known_relief(const RawMaterial& raw, const ReliefProgress& progress = {});

// Returns for each texel of a view the texels of the relief that it shows.
std::vector<Taps> relief_taps(const nook::material::Relief& relief, std::uint32_t width, std::uint32_t height,
                              Vec3 view);

// Replaces images, row x view x texel as in RawMaterial::btf, by images on the relief's points. In each view,
// the new image shows the given one with the least squared error. Points that the view does not show keep the
// colour of what hides them. Progress counts views.
void move_to_relief(const RawMaterial& raw, const nook::material::Relief& relief, std::vector<float>& values,
                    const ReliefProgress& progress = {});

}  // namespace nook::bake::material
