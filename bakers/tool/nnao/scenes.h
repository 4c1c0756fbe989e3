// The scenes of `nook evaluate nnao`, with their cameras and radii.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/measure/nnao/scene_views.h"

namespace nook::tool {

inline constexpr float degree = 0.017453293f;                           // radians
inline constexpr float smallest_radius = 1e-3f, largest_radius = 1e3f;  // of AO, metres

// The options, still as text.
struct SceneWords {
  std::vector<std::filesystem::path> files;
  bool thin = false;
  bake::LinkedFiles linked = bake::LinkedFiles::folder;  // of all files
  std::vector<std::string> cameras;  // [NAME:]ox,oy,oz,tx,ty,tz,fov; without a name, of every scene
  std::vector<std::string> radii;    // [NAME:]metres
};

// Throws ToolError (bad arguments).
std::vector<measure::SceneRequest> parse_scenes(const SceneWords& words);

}  // namespace nook::tool
