// A network in the layout of the shaders.
#pragma once

#include "sdk/src/nnao/network.h"
#include "sdk/src/nnao/taps.h"

namespace nook::gl {

// Returns the uniform array nook_network of horizon.glsl or paper.glsl; its length is a multiple of four.
// The weights of the horizon form's means are those of sums over the grid.
Vector<float> network_constants(const nnao::Network& network, nnao::TapGrid grid, Memory* memory);

}  // namespace nook::gl
