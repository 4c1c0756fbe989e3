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

// Makes a relief from heights over z = 0 in tiles, in the texel order x * height + y. It supports view angles
// up to the largest tilt of the raw material, at most 80 degrees. `steps` is the number of steps of the
// march. If it is 0, the relief is a plane at the mean height.
nook::material::Relief relief_of_heights(const RawMaterial& raw, const std::vector<float>& heights,
                                         std::uint32_t steps = default_relief_steps);

// Throws Failure(INVALID_ARGUMENT) if the raw material has no heights, if their number differs from the
// number of texels, or if they exceed the limits of a file.
void check_heights(const RawMaterial& raw);

// Estimates the heights at which the views agree. Candidates are these heights smoothed over several lengths,
// a plane at their mean, and no relief at all. Returns the candidate with which some views of the raw
// material predict the other views best. With fewer than 8 views, returns no relief.
nook::material::Relief estimate_relief(const RawMaterial& raw, const ReliefProgress& progress = {});

// Like estimate_relief(), for the raw material's own heights. The heights without smoothing are a candidate
// too. Throws what check_heights() throws.
nook::material::Relief known_relief(const RawMaterial& raw, const ReliefProgress& progress = {});

// For each texel of a view, returns the texels of the relief that it shows.
std::vector<Taps> relief_taps(const nook::material::Relief& relief, std::uint32_t width, std::uint32_t height,
                              Vec3 view);

// Replaces the images in `values` (row x view x texel, as in RawMaterial::btf) by images on the points of the
// relief. Each new image is chosen so that its view shows the given image with the least squared error.
// Points that a view does not show keep the colour of the point that hides them. Progress counts views.
void move_to_relief(const RawMaterial& raw, const nook::material::Relief& relief, std::vector<float>& values,
                    const ReliefProgress& progress = {});

}  // namespace nook::bake::material
