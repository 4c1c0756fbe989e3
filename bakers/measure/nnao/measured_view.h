// One camera with everything that methods are measured against.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bakers/measure/nnao/traced_truth.h"

namespace nook::measure {

struct MeasuredView {
  std::string scene;
  float radius = 0;  // metres
  bake::nnao::TracedView view;
  bake::nnao::TracedView slid;  // the image slides by one pixel
  std::vector<float> truth;
  double noise = 0;  // expected squared error of the truth
};

struct TruthSettings {
  std::uint32_t width = 640, height = 360;  // pixels
  std::uint32_t rays = 128;
  float radius = 0.5f;  // metres
  std::uint64_t seed = 1;
};

MeasuredView measure_view(const bake::RayScene& rays, const std::string& scene,
                          const bake::nnao::Camera& camera, const TruthSettings& settings);

// A view of one training scene of each of the first eight families, radii of 0.25, 0.5 and 1 metre in turn:
// what the baselines are tuned on. Returns false from progress to stop, which throws Failure(CANCELLED).
std::vector<MeasuredView> tuning_views(std::uint64_t seed,
                                       const std::function<bool(std::size_t, std::size_t)>& progress);

}  // namespace nook::measure
