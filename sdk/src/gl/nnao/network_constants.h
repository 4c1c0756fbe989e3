// A network in the layout of the shaders.
#pragma once

#include <vector>

#include "sdk/src/nnao/network.h"

namespace nook::gl {

// Returns the uniform array nook_network of horizon.glsl or paper.glsl; its length is a multiple of four.
std::pmr::vector<float> network_constants(const nnao::Network& network, std::pmr::memory_resource* memory);

}  // namespace nook::gl
