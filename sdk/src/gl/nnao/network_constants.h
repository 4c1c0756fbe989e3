// A network in the layout of the shaders.
#pragma once

#include <vector>

#include "sdk/src/nnao/network.h"

namespace nook::gl {

// Returns the uniform array nook_network of horizon.glsl or paper.glsl; its length is a multiple of four.
Vector<float> network_constants(const nnao::Network& network, Memory* memory);

}  // namespace nook::gl
