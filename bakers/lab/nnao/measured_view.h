// Views of scenes. Each view has the ray-traced references that methods are compared with.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bakers/import/import_options.h"
#include "bakers/lab/nnao/traced_truth.h"
#include "bakers/lab/nnao/truth_store.h"

namespace nook::lab {

// One camera.
struct MeasuredView {
  std::string scene, source;  // the default source is the scene itself
  std::string camera;         // its name, or empty
  float radius = 0;           // metres
  bake::nnao::TracedView view;
  bake::nnao::TracedView slid;  // the same view, shifted by one pixel
  std::vector<float> truth;
  double noise = 0;             // expected squared error of the reference
  std::vector<BentTruth> bent;  // if the settings request it
  // Earlier frames, the oldest first, if the settings request a path.
  std::vector<bake::nnao::TracedView> path;
};

MeasuredView measure_view(const bake::RayScene& rays, const std::string& scene,
                          const bake::nnao::Camera& camera, const TruthSettings& settings,
                          const TruthStore& store = {});

// Returns the 24 views on which baselines are tuned. Each shows a different training scene. The views use the
// scene families in turn, and also the radii 0.25, 0.5 and 1 metre. If `progress` returns false, the function
// throws Failure(CANCELLED).
std::vector<MeasuredView> tuning_views(std::uint64_t seed,
                                       const std::function<bool(std::size_t, std::size_t)>& progress);

struct GivenCamera {
  Vec3 eye, target;  // metres
  float fov = 0;     // vertical, radians
  std::string name = {};
  float radius = 0;  // metres; 0 uses the scene's radius
};

struct SceneRequest {
  std::string name;            // the file's name without extension, or "thin"
  std::filesystem::path file;  // if empty, uses the built-in scene of thin objects
  float radius = 0.5f;         // metres
  std::vector<GivenCamera> cameras;
  bake::ImportOptions reading;
  std::string source = {};  // if empty, the scene's name
};

// Reads the scene and traces its views. If the scene names no camera, the function places `placed` cameras.
// `references` is a folder that caches references; if it is empty, nothing is cached. `progress` counts
// views. If it returns false, the function throws Failure (CANCELLED). Throws Failure (BAD_FILE) for a scene
// that cannot be read.
std::vector<MeasuredView> trace_views(
    const SceneRequest& scene, TruthSettings truth, std::uint32_t placed,
    const std::filesystem::path& references,
    const std::function<bool(std::size_t done, std::size_t total)>& progress);

}  // namespace nook::lab
