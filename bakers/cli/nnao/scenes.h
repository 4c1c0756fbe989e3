// The scenes that `nook evaluate nnao` is asked for, with their cameras and radii.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/common_options.h"
#include "cli/nnao/measured_view.h"

namespace nook::cli {

struct GivenCamera {
  Vec3 eye, target;
  float fov = 0;  // vertical, radians
};

struct SceneRequest {
  std::string name;            // the file's without its extension, or thin
  std::filesystem::path file;  // empty: the built-in scene of thin things
  float radius = 0.5f;         // metres
  std::vector<GivenCamera> cameras;
};

// What the options say, still as text.
struct SceneWords {
  std::vector<std::filesystem::path> files;
  bool thin = false;
  std::vector<std::string> cameras;  // [NAME:]ox,oy,oz,tx,ty,tz,fov; without a name, of every scene
  std::vector<std::string> radii;    // [NAME:]metres
};

// Throws ToolError (bad arguments).
std::vector<SceneRequest> parse_scenes(const SceneWords& words);

// Reads the scene and traces its views; placed: how many cameras to place where none is given. Throws
// ToolError that names the file, and Failure(CANCELLED) after Ctrl-C.
std::vector<MeasuredView> trace_views(const SceneRequest& scene, TruthSettings truth, std::uint32_t placed,
                                      const CommonOptions& common);

}  // namespace nook::cli
