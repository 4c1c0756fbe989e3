// Heights of a raw material's relief, from what its views agree on.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "bakers/material/raw_material.h"

namespace nook::bake::material {

// Called with the steps that are done; returns false to stop with Failure(NOOK_ERROR_CANCELLED).
using ReliefProgress = std::function<bool(std::size_t done, std::size_t total)>;

// Returns heights over the plane z = 0 in tiles, one for each texel. The views within 53 degrees of the
// normal show the most similar colours there, in 3 x 3 texels. 49 heights up to 0.24 tiles on either side are
// tried, and a parabola places the result between them. Progress counts texels. The same bits on any number
// of threads.
std::vector<float> heights_of_views(const RawMaterial& raw, const ReliefProgress& progress = {});

}  // namespace nook::bake::material
