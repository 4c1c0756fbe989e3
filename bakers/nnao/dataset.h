// The training set: G-buffers of procedural scenes, and ray-traced AO at points of them. A tap's inputs are
// made from the G-buffers whenever they are needed, so that 500,000 points take some hundred megabytes.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bakers/nnao/cameras.h"

namespace nook::bake::nnao {

struct DatasetSettings {
  std::uint32_t scenes = 120;  // at least 20: two of each family
  std::uint32_t views = 720;
  std::uint32_t points_per_view = 1000;
  std::uint32_t rays = 128;  // for each point
  std::uint32_t width = 480, height = 270;
  bool normals = true;  // keep the normals of all pixels, which only the paper's form reads
  std::uint64_t seed = 1;
};

// A pixel and its reference AO.
struct DataPoint {
  std::uint32_t view = 0;
  std::uint16_t x = 0, y = 0;
  Vec3 normal;       // view space
  float radius = 0;  // metres; never more than max_radius_px on the screen
  float ao = 1;      // ray-traced AO, with rays as long as the radius
};

struct Dataset {
  // The clamp of the pass at this height.
  static constexpr float max_radius_px = 100;

  std::vector<TracedView> views;
  std::vector<DataPoint> training, validation;  // no scene is in both
};

// done and total count scenes. Returns false to stop. Any thread calls it, one call at a time.
using DatasetProgress = std::function<bool(std::size_t done, std::size_t total)>;

// Returns the same bits for the same settings on any number of threads. Throws Failure: INVALID_ARGUMENT,
// CANCELLED (progress returned false).
Dataset make_dataset(const DatasetSettings& settings, const DatasetProgress& progress = {});

// Returns points of one view, whose radii are uniform in their logarithm.
std::vector<DataPoint> trace_points(const RayScene& rays, const TracedView& view, std::uint32_t view_index,
                                    std::uint32_t points, std::uint32_t ray_count, std::uint64_t seed);

}  // namespace nook::bake::nnao
