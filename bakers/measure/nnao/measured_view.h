// One camera with everything that methods are measured against.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bakers/measure/nnao/bent_truth.h"
#include "bakers/measure/nnao/truth_store.h"

namespace nook::measure {

struct MeasuredView {
  std::string scene, source;  // a scene without a source is one of its own
  std::string camera;         // its name; empty: none
  float radius = 0;           // metres
  bake::nnao::TracedView view;
  bake::nnao::TracedView slid;  // the image slides by one pixel
  std::vector<float> truth;
  double noise = 0;             // expected squared error of the truth
  std::vector<BentTruth> bent;  // if the settings want it
  // The frames before the view, the oldest first, if the settings want a path.
  std::vector<bake::nnao::TracedView> path;
};

MeasuredView measure_view(const bake::RayScene& rays, const std::string& scene,
                          const bake::nnao::Camera& camera, const TruthSettings& settings,
                          const TruthStore& store = {});

// 24 views, each of a training scene of its own, the families and radii of 0.25, 0.5 and 1 metre in turn:
// what the baselines are tuned on. Return false from progress to stop, which throws Failure(CANCELLED).
std::vector<MeasuredView> tuning_views(std::uint64_t seed,
                                       const std::function<bool(std::size_t, std::size_t)>& progress);

}  // namespace nook::measure
