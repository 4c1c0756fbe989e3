// Caches references in a folder. Without the cache, a repeated measurement would spend most of its time on
// tracing.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "bakers/lab/nnao/camera_path.h"
#include "bakers/lab/nnao/traced_truth.h"

namespace nook::lab {

struct TruthSettings {
  std::uint32_t width = 640, height = 360;  // pixels
  std::uint32_t rays = 128;
  float radius = 0.5f;  // metres
  std::uint64_t seed = 1;
  // If this is n > 0, bent normals and reflections are traced at every n-th pixel of every n-th row. They are
  // not cached.
  std::uint32_t bent_stride = 0;
  PathSettings path;  // camera path that ends at the view
};

struct Truth {
  std::vector<float> ao;
  double noise = 0;  // expected squared error
};

class TruthStore {
 public:
  TruthStore() = default;  // caches nothing
  // The folder must exist. If it is empty, nothing is cached.
  TruthStore(std::filesystem::path folder, const bake::TriangleSoup& scene);

  // Returns the cached reference if the folder has one for the same triangles, camera and settings. Otherwise
  // calls `trace`, caches the result and returns it. The reference is also traced again if its file is
  // damaged.
  Truth read_or_trace(const bake::nnao::Camera& camera, const TruthSettings& settings,
                      const std::function<Truth()>& trace) const;

 private:
  std::filesystem::path folder_;
  std::uint64_t scene_ = 0;  // hash of the triangles
};

}  // namespace nook::lab
