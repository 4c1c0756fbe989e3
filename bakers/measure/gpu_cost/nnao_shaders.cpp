#include "bakers/measure/gpu_cost/shader_cases.h"
#include "bakers/measure/gpu_cost/trip_counts.h"

namespace nook::measure {
namespace {

struct Grid {
  int taps, groups, steps;
};
// horizon_grid of sdk/src/nnao/taps.h.
constexpr Grid grids[] = {{9, 3, 3}, {16, 4, 4}, {32, 8, 4}, {64, 8, 8}};

std::string defines(bool half, bool horizon, const Grid& grid) {
  return "#define NOOK_HALF " + std::to_string(half) + "\n#define NOOK_HORIZON " + std::to_string(horizon) +
         "\n#define NOOK_DIRECTIONS " + std::to_string(grid.groups) + "\n#define NOOK_STEPS " +
         std::to_string(grid.steps) + "\n";
}

std::vector<Loop> grid_loops(const char* groups, const Grid& grid) {
  return {{groups, double(grid.groups), {{"steps", double(grid.steps), {}}}}};
}

// Compilers unroll the steps of a direction, and directions where their number is a constant.
std::vector<Loop> direction_loops(const Grid& grid) {
  if (grid.groups <= 4) return {};
  return {{"directions", double(grid.groups), {}}};
}

// Compilers unroll four steps of the paper's form.
std::vector<Loop> paper_loops(const Grid& grid) {
  if (grid.steps > 4) return grid_loops("groups of taps", grid);
  return {{"groups of taps", double(grid.groups), {}}};
}

ShaderCase baseline(const std::string& file, const std::string& name, const std::vector<Loop>& loops = {}) {
  return tree_shader(Stage::fragment, "bakers/measure/nnao/shaders/" + file, name, "", loops);
}

}  // namespace

std::vector<ShaderCase> nnao_shaders() {
  std::vector<ShaderCase> shaders;
  for (const bool half : {false, true}) {
    const std::string size = half ? ", half" : "";
    const auto add = [&](Stage stage, const char* file, const std::string& variant,
                         const std::string& defines, const std::vector<Loop>& loops) {
      shaders.push_back(
          tree_shader(stage, std::string("shaders/nnao/") + file, file + variant + size, defines, loops));
    };
    add(Stage::fragment, "depth.frag", "", defines(half, true, grids[0]), {});
    add(Stage::fragment, "normals.frag", "", defines(half, false, grids[1]), {});
    for (const Grid& grid : grids) {
      const std::string taps = ", " + std::to_string(grid.taps);
      add(Stage::fragment, "occlusion.frag", taps, defines(half, true, grid),
          direction_loops(grid));
      add(Stage::compute, "occlusion.comp", taps, defines(half, true, grid),
          direction_loops(grid));
      if (grid.taps == 16 || grid.taps == 64)
        add(Stage::fragment, "occlusion.frag", ", paper's form" + taps, defines(half, false, grid),
            paper_loops(grid));
    }
    if (half) add(Stage::fragment, "filter.frag", "", defines(half, true, grids[0]), {});
    add(Stage::fragment, "resolve.frag", "", defines(half, true, grids[0]), {});
  }
  return shaders;
}

std::vector<ShaderCase> baseline_shaders() {
  std::vector<ShaderCase> shaders;
  const auto add = [&](const char* file, const std::string& method, int taps,
                       const std::vector<Loop>& loops) {
    shaders.push_back(baseline(file, method + " " + std::to_string(taps), loops));
  };
  for (const Grid& grid : {grids[1], grids[2], grids[3]})
    add("hbao.frag", "HBAO", grid.taps, grid_loops("directions", grid));
  // Steps are those on one side of a slice.
  for (const Grid& grid : {Grid{16, 2, 4}, Grid{18, 3, 3}, Grid{64, 4, 8}}) {
    const double steps = grid.steps;
    const std::vector<Loop> loops = {
        {"slices", double(grid.groups), {{"steps behind", steps, {}}, {"steps ahead", steps, {}}}}};
    add("gtao.frag", "GTAO", grid.taps, loops);
    add("bitmask.frag", "GTAO with bitmask", grid.taps, loops);
  }
  for (const int taps : {4, 8, 16}) {
    add("ssao.frag", "SSAO", taps, {{"taps", double(taps), {}}});
    add("ssao_plus.frag", "SSAO+", taps, {{"taps", double(taps), {}}});
  }
  shaders.push_back(baseline("blur.frag", baseline_blur));
  return shaders;
}

}  // namespace nook::measure
