// The training set: G-buffers of procedural scenes, and ray-traced AO at some points. The inputs of the taps
// are not stored. Training computes them from the G-buffers when it needs them, so that 864,000 points take
// only 0.8 GB.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bakers/nnao/cameras.h"

namespace nook::bake::nnao {

struct DatasetSettings {
  std::uint32_t scenes = 240;  // at least 48: two of each family
  std::uint32_t views = 1440;
  std::uint32_t points_per_view = 600;
  std::uint32_t rays = 128;                 // per point
  std::uint32_t width = 480, height = 270;  // other aspect ratios have as many pixels
  bool normals = true;  // keeps the normals of all pixels, which only the paper form reads

  // The share of views whose G-buffer contains host-like normals, see host_normals.h. The reference AO is
  // still traced around the triangle's normal. The share affects only the normals of a view.
  float host_normal_share = 0;
  std::uint64_t seed = 1;
};

// A pixel and its reference AO. Half of the radii are log-uniform in metres, from 0.05 m to 2.5 m. The other
// half are log-uniform in pixels, from 3 to 130. Radii in metres are raised to at least 3 pixels. They also
// have an upper limit, because hosts clamp the radius where a surface is close. The limit of each point is
// log-uniform from 40 to 130 pixels. Flat pixels, where the screen shows a single plane within the radius,
// are chosen less often, by a factor of flat_share.
struct DataPoint {
  std::uint32_t view = 0;
  std::uint16_t x = 0, y = 0;
  Vec3 normal;          // from the G-buffer, view space
  float radius = 0;     // metres; never more than max_radius_px on the screen
  float ao = 1;         // AO traced around the triangle's normal; rays are as long as the radius
  Vec3 open_direction;  // view space: mean direction of the rays that hit nothing, see trace_openness
};

struct Dataset {
  static constexpr float min_radius_px = 3, max_radius_px = 130;
  static constexpr float flat_share = 0.4f;

  std::vector<TracedView> views;
  std::vector<DataPoint> training, validation;  // no scene is in both
};

// `done` and `total` are numbers of scenes. Return false to stop. Any thread may call the function, but never
// two at the same time.
using DatasetProgress = std::function<bool(std::size_t done, std::size_t total)>;

// Returns the same bits for the same settings on any number of threads. Throws Failure(INVALID_ARGUMENT), or
// Failure(CANCELLED) if `progress` returned false.
Dataset make_dataset(const DatasetSettings& settings, const DatasetProgress& progress = {});

// Returns how far from the surface a ray should start, in metres. The distance is far smaller than the radius
// and the objects, but larger than the rounding error of a hit.
float origin_offset(Vec3 position, float depth, float radius);

// Returns points of one view. Their normals come from the view's G-buffer.
std::vector<DataPoint> trace_points(const RayScene& rays, const TracedView& view, std::uint32_t view_index,
                                    std::uint32_t points, std::uint32_t ray_count, std::uint64_t seed);

}  // namespace nook::bake::nnao
