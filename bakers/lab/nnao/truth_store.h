// Keeps references in a folder, because tracing takes most of the time of a second measurement.
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
  // > 0: also traces bent normals and reflections, at every n-th pixel of both axes. They are not kept.
  std::uint32_t bent_stride = 0;
  PathSettings path;  // path to the view
};

struct Truth {
  std::vector<float> ao;
  double noise = 0;  // expected squared error
};

class TruthStore {
 public:
  TruthStore() = default;  // keeps nothing
  // The folder must exist; empty: keeps nothing.
  TruthStore(std::filesystem::path folder, const bake::TriangleSoup& scene);

  // Returns the reference of the same triangles, camera and settings from the folder. Otherwise, returns and
  // keeps what trace returns. A damaged file is traced again.
  Truth read_or_trace(const bake::nnao::Camera& camera, const TruthSettings& settings,
                      const std::function<Truth()>& trace) const;

 private:
  std::filesystem::path folder_;
  std::uint64_t scene_ = 0;  // hash of the triangles
};

}  // namespace nook::lab
