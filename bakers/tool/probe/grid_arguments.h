// The arguments of commands that name a grid of probes.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "sdk/src/core/vec.h"

namespace nook::tool {

struct BoxArgument {
  bool given = false;
  Vec3 low_ws, high_ws;  // metres
};

// AxBxC. Throws ToolError(bad arguments).
std::array<std::uint32_t, 3> parse_grid_counts(const std::string& text);
// x0,y0,z0,x1,y1,z1. Throws ToolError(bad arguments).
BoxArgument parse_grid_box(const std::string& text);

}  // namespace nook::tool
