// The relief of a raw material, and its views on the points of that relief; see Relief in sdk's
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

// The relief of heights over z = 0 in tiles, texel x * height + y, whose views reach to those of the raw
// material, at most to 80 degrees. Steps of the march; 0: a plane at the heights' mean.
nook::material::Relief relief_of_heights(const RawMaterial& raw, const std::vector<float>& heights,
                                         std::uint32_t steps = default_relief_steps);

// Throws Failure(INVALID_ARGUMENT) where the raw material's heights are not known, are not as many as texels,
// or go beyond those of a file.
void check_heights(const RawMaterial& raw);

// Of the heights that the views agree on, smoothed over several lengths, their mean as a plane, and no relief
// at all: that on which views of the raw material are predicted best from the others. Without at least 8
// views there is no relief.
nook::material::Relief estimate_relief(const RawMaterial& raw, const ReliefProgress& progress = {});

// The same of the raw material's own heights, as they are too. Throws what check_heights() throws.
nook::material::Relief known_relief(const RawMaterial& raw, const ReliefProgress& progress = {});

// For each texel of a view, the texels of the relief that it shows.
std::vector<Taps> relief_taps(const nook::material::Relief& relief, std::uint32_t width, std::uint32_t height,
                              Vec3 view);

// Replaces images, row x view x texel as in RawMaterial::btf, by those on the relief's points: in each view
// the ones that show the given image with the least squared error. Points that the view does not show keep
// what stands before them. Progress counts views.
void move_to_relief(const RawMaterial& raw, const nook::material::Relief& relief, std::vector<float>& values,
                    const ReliefProgress& progress = {});

}  // namespace nook::bake::material
