// A list of test views for `nook evaluate nnao --views`: scenes by source with their cameras, and the ratios
// that are reported.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/measure/nnao/report.h"
#include "bakers/measure/nnao/scene_views.h"

namespace nook::tool {

struct ViewsFile {
  std::string size;        // WxH; empty: not stated
  std::uint32_t rays = 0;  // 0: not stated
  std::vector<measure::SceneRequest> scenes;
  std::vector<measure::MethodRatio> ratios;
};

// folder: where the scenes lie, each as NAME.glb. Throws ToolError (bad input) that names the file and the
// fault.
ViewsFile read_views_file(const std::filesystem::path& path, const std::filesystem::path& folder);

// Reads METHOD:TAPS,METHOD:TAPS. Throws ToolError (bad arguments).
measure::MethodRatio parse_ratio(const std::string& text);

}  // namespace nook::tool
