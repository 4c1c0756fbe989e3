// The definitions that a pass puts before its shaders, and the network's numbers in their layout.
#pragma once

#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/nnao/network.h"
#include "sdk/src/nnao/taps.h"

namespace nook::gl {

struct PassDefines {
  char text[320] = "";
};

// horizon: the network has the horizon form.
PassDefines pass_defines(const NnaoSettings& desc, bool horizon, const nnao::TapGrid& grid);

// Returns the uniform array nook_network of horizon.glsl or paper.glsl; its length is a multiple of four. In
// the horizon form, weights of means are divided by the counts, because the shader sums over the grid.
Vector<float> network_constants(const nnao::Network& network, nnao::TapGrid grid, Memory* memory);

}  // namespace nook::gl
