// Lists all ways to fit a probe: Nook's, and others to compare with.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/measure/probe/method_error.h"

namespace nook::lab {

// Returns all variants of Gaussian fits with `lobes` lobes. If the region is the whole sphere, also returns
// spherical harmonics and ambient dice.
std::vector<bake::probe::ProbeMethod> probe_methods(std::uint32_t lobes, const bake::probe::Region& region);

}  // namespace nook::lab
