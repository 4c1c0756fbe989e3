// Makes the #define lines that a pass puts before its shaders, and the network's weights in the layout of the
// shaders.
#pragma once

#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/nnao/network.h"
#include "sdk/src/nnao/taps.h"

namespace nook::gl {

struct PassDefines {
  char text[320] = "";
};

// Pass true for `horizon` if the network has the horizon form.
PassDefines pass_defines(const NnaoSettings& desc, bool horizon, const nnao::TapGrid& grid);

// Returns the values of the uniform array nook_network in horizon.glsl or paper.glsl. The length is a
// multiple of four. In the horizon form, the weights of means are divided by the number of steps or
// directions, because the shader sums instead of averaging.
Vector<float> network_constants(const nnao::Network& network, nnao::TapGrid grid, Memory* memory);

}  // namespace nook::gl
