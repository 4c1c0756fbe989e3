// A network as the shaders read it.
#pragma once

#include <vector>

#include "sdk/src/nnao/network.h"

namespace nook::gl {

// The uniform array nook_network of horizon.glsl or paper.glsl, in multiples of four.
std::pmr::vector<float> network_constants(const nnao::Network& network, std::pmr::memory_resource* memory);

}  // namespace nook::gl
