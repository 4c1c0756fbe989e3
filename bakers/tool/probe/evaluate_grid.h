// nook evaluate probe GRID.nook --scene SCENE --light MAP: irradiance of baked grids against path tracing.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "bakers/tool/common_options.h"

namespace nook::tool {

struct EvaluateGridOptions {
  std::filesystem::path scene, light;
  std::uint32_t points = 1024;  // of each kind
  std::uint32_t paths = 2048;   // a point
  std::uint32_t max_bounces = ~0u;
  bool no_textures = false;
  bake::LinkedFiles linked = bake::LinkedFiles::folder;
  std::string direct;  // empty: as each grid was baked
};

// Three rows a grid: points on surfaces, the same with probes looked up half a cell off along the normal, and
// points in the open.
nlohmann::ordered_json evaluate_grids(const EvaluateGridOptions& options, const CommonOptions& common,
                                      const std::vector<std::filesystem::path>& grids);

}  // namespace nook::tool
