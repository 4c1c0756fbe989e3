// The views that a scene is measured from, traced.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bakers/import/linked_files.h"
#include "bakers/measure/nnao/measured_view.h"

namespace nook::measure {

struct GivenCamera {
  Vec3 eye, target;  // metres
  float fov = 0;     // vertical, radians
  std::string name = {};
  float radius = 0;  // metres; 0: the scene's
};

struct SceneRequest {
  std::string name;            // the file's without its extension, or thin
  std::filesystem::path file;  // empty: the built-in scene of thin things
  float radius = 0.5f;         // metres
  std::vector<GivenCamera> cameras;
  bake::LinkedFiles linked = bake::LinkedFiles::folder;
  std::string source = {};  // empty: the scene's name
};

// Reads the scene and traces its views; placed: how many cameras to place where none is given. references: a
// folder of kept references; empty: none. progress counts views; false stops, which throws Failure
// (CANCELLED). Throws Failure (BAD_FILE) for a scene that cannot be read.
std::vector<MeasuredView> trace_views(
    const SceneRequest& scene, TruthSettings truth, std::uint32_t placed,
    const std::filesystem::path& references,
    const std::function<bool(std::size_t done, std::size_t total)>& progress);

}  // namespace nook::measure
