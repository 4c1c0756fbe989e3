#include "bakers/tool/probe/grid_arguments.h"

#include <cstdio>

#include "bakers/tool/tool_error.h"
#include "sdk/src/core/geometry.h"

namespace nook::tool {

std::array<std::uint32_t, 3> parse_grid_counts(const std::string& text) {
  std::array<std::uint32_t, 3> counts{};
  int used = 0;
  if (std::sscanf(text.c_str(), "%ux%ux%u%n", &counts[0], &counts[1], &counts[2], &used) != 3 ||
      std::size_t(used) != text.size() || counts[0] < 1 || counts[1] < 1 || counts[2] < 1 ||
      counts[0] > 1024 || counts[1] > 1024 || counts[2] > 1024)
    throw ToolError(exit_bad_arguments,
                    "--grid: got " + text + ", need AxBxC, probes along x, y and z, each 1 to 1024");
  return counts;
}

BoxArgument parse_grid_box(const std::string& text) {
  float v[6];
  int used = 0;
  bool good =
      std::sscanf(text.c_str(), "%f,%f,%f,%f,%f,%f%n", v, v + 1, v + 2, v + 3, v + 4, v + 5, &used) == 6 &&
      std::size_t(used) == text.size();
  good = good && is_place({v[0], v[1], v[2]}) && is_place({v[3], v[4], v[5]});
  for (int i = 0; good && i < 3; ++i) good = v[i] <= v[i + 3];
  if (!good)
    throw ToolError(exit_bad_arguments, "--box: got " + text +
                                            ", need x0,y0,z0,x1,y1,z1: the low corner, then the high one, in "
                                            "metres up to 1e6");
  return {true, {v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

}  // namespace nook::tool
