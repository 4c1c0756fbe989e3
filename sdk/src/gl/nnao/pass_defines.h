// The definitions that a pass puts before its shaders.
#pragma once

#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/nnao/taps.h"

namespace nook::gl {

struct PassDefines {
  char text[320] = "";
};

// horizon: the network has the horizon form.
PassDefines pass_defines(const NnaoSettings& desc, bool horizon, const nnao::TapGrid& grid);

}  // namespace nook::gl
