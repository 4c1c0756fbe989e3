// The training set: G-buffers of procedural scenes, and ray-traced AO at some points. A tap's inputs are made
// from the G-buffers when they are needed, so that 864,000 points take 0.8 GB.
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
  std::uint32_t width = 480, height = 270;  // screens of other shapes have the same number of pixels
  bool normals = true;  // keep the normals of all pixels; only the paper's form reads them

  // The share of views whose G-buffer has normals like a host's, see host_normals.h. The reference remains
  // around the triangle's normal. Nothing else of a view depends on the share.
  float host_normal_share = 0;
  std::uint64_t seed = 1;
};

// A pixel and its reference AO. Half of the radii have a uniform logarithm in metres, from 0.05 m to 2.5 m,
// and half in pixels, from 3 to 130. Radii in metres become at least 3 pixels. They are also limited, as
// hosts clamp the radius where a surface is close: the limit of each point has a uniform logarithm from 40 to
// 130 pixels. Pixels whose screen shows one plane as far as the radius are chosen less often, by a factor of
// flat_share.
struct DataPoint {
  std::uint32_t view = 0;
  std::uint16_t x = 0, y = 0;
  Vec3 normal;          // from the G-buffer, view space
  float radius = 0;     // metres; never more than max_radius_px on the screen
  float ao = 1;         // ray-traced AO around the triangle's normal, with rays as long as the radius
  Vec3 open_direction;  // view space: the mean direction of the rays that hit nothing, see trace_openness
};

struct Dataset {
  static constexpr float min_radius_px = 3, max_radius_px = 130;
  static constexpr float flat_share = 0.4f;

  std::vector<TracedView> views;
  std::vector<DataPoint> training, validation;  // no scene is in both
};

// done and total count scenes. Return false to stop. Any thread calls it, one call at a time.
using DatasetProgress = std::function<bool(std::size_t done, std::size_t total)>;

// Returns the same bits for the same settings on any number of threads. Throws Failure: INVALID_ARGUMENT,
// CANCELLED (progress returned false).
Dataset make_dataset(const DatasetSettings& settings, const DatasetProgress& progress = {});

// Returns the distance of a ray's origin from the surface in metres. It is far below the radius and the size
// of things, and above the rounding of a hit.
float origin_offset(Vec3 position, float depth, float radius);

// Returns points of one view, with the view's normals.
std::vector<DataPoint> trace_points(const RayScene& rays, const TracedView& view, std::uint32_t view_index,
                                    std::uint32_t points, std::uint32_t ray_count, std::uint64_t seed);

}  // namespace nook::bake::nnao
