// The Gaussian stack of an exemplar: versions of growing blur, all with as many texels as the exemplar.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/synthesis/exemplar.h"

namespace nook::bake::synthesis {

// Returns levels + 1 versions. The first is the exemplar; each further one is the last, filtered along both
// axes with (1, 4, 6, 4, 1) / 16 at a spacing of 1, 2, 4, ... texels.
std::vector<tensor::Matrix> gaussian_stack(const Exemplar& exemplar, std::uint32_t levels);

}  // namespace nook::bake::synthesis
