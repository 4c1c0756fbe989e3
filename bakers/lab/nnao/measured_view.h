// The views of scenes, with all references for methods.
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
  std::string scene, source;  // a scene without a source is its own source
  std::string camera;         // its name; empty: none
  float radius = 0;           // metres
  bake::nnao::TracedView view;
  bake::nnao::TracedView slid;  // same view, slid by one pixel
  std::vector<float> truth;
  double noise = 0;             // expected squared error of the truth
  std::vector<BentTruth> bent;  // if the settings request it
  // Earlier frames, the oldest first, if the settings request a path.
  std::vector<bake::nnao::TracedView> path;
};

MeasuredView measure_view(const bake::RayScene& rays, const std::string& scene,
                          const bake::nnao::Camera& camera, const TruthSettings& settings,
                          const TruthStore& store = {});

// Returns 24 views of different training scenes, with families and radii of 0.25, 0.5 and 1 metre in turn.
// Baselines are tuned on them. Return false from progress to stop, which throws Failure(CANCELLED).
std::vector<MeasuredView> tuning_views(std::uint64_t seed,
                                       const std::function<bool(std::size_t, std::size_t)>& progress);

struct GivenCamera {
  Vec3 eye, target;  // metres
  float fov = 0;     // vertical, radians
  std::string name = {};
  float radius = 0;  // metres; 0: the scene's
};

struct SceneRequest {
  std::string name;            // the file's name without extension, or thin
  std::filesystem::path file;  // empty: the built-in scene of thin things
  float radius = 0.5f;         // metres
  std::vector<GivenCamera> cameras;
  bake::ImportOptions reading;
  std::string source = {};  // empty: the scene's name
};

// Reads the scene and traces its views. placed: how many cameras to place if none is given. references: a
// folder of kept references; empty: none. progress counts views; false stops, which throws Failure
// (CANCELLED). Throws Failure (BAD_FILE) for a scene that cannot be read.
std::vector<MeasuredView> trace_views(
    const SceneRequest& scene, TruthSettings truth, std::uint32_t placed,
    const std::filesystem::path& references,
    const std::function<bool(std::size_t done, std::size_t total)>& progress);

}  // namespace nook::lab
