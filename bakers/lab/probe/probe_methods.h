// Every way to fit a probe: those that Nook offers, and those of others that it is measured beside.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/measure/probe/method_error.h"

namespace nook::lab {

// All forms of Gaussian fits with `lobes` lobes, and on the sphere spherical harmonics and ambient dice.
std::vector<bake::probe::ProbeMethod> probe_methods(std::uint32_t lobes, const bake::probe::Region& region);

}  // namespace nook::lab
