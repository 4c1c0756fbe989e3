#include "bakers/measure/nnao/bent_truth.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/specular_visibility.h"

namespace nook::measure {
namespace {

// The same as in traced_truth.cpp.
constexpr float origin_offset = 3e-4f;

}  // namespace

std::vector<BentTruth> trace_bent_truth(const bake::RayScene& rays, const bake::nnao::TracedView& view,
                                        float radius, std::uint32_t ray_count, std::uint64_t seed,
                                        std::uint32_t stride) {
  const bake::nnao::Camera& camera = view.camera;
  std::vector<BentTruth> truths;
  std::vector<bake::GlossyPoint> points;
  std::vector<Vec3> position, normal;
  for (std::uint32_t y = stride / 2; y < camera.height; y += stride)
    for (std::uint32_t x = stride / 2; x < camera.width; x += stride) {
      const std::size_t pixel = std::size_t(y) * camera.width + x;
      if (!std::isfinite(view.depth[pixel])) continue;
      const bake::nnao::PixelRay ray = bake::nnao::pixel_ray(camera, float(x) + 0.5f, float(y) + 0.5f);
      truths.push_back({.pixel = pixel, .bent_normal = {}});
      position.push_back(ray.origin_ws + view.depth[pixel] * ray.direction_ws);
      normal.push_back(transform_vector(camera.world_from_view, view.normal[pixel]));
      points.push_back(
          {position.back(), normal.back(), normalised(-ray.direction_ws), radius, origin_offset});
    }
  bake::AoSettings settings;
  settings.rays = ray_count;
  settings.seed = seed;
  settings.radius = radius;
  settings.origin_offset = origin_offset;
  const bake::Openness open = bake::trace_openness(rays, {position, normal}, settings);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, truths.size(), 64), [&](const auto& range) {
    const bake::FlushDenormals flush;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      truths[i].ao = open.ao[i];
      truths[i].bent_normal = bake::nnao::view_direction(camera, normalised(open.direction[i]));
      for (std::size_t r = 0; r < measured_roughness.size(); ++r)
        truths[i].specular[r] = bake::trace_specular_visibility(
            rays, points[i], measured_roughness[r], std::max(ray_count / 4, 1u),
            bake::mix_bits(seed ^ bake::mix_bits(i * 8 + r)));
    }
  });
  return truths;
}

}  // namespace nook::measure
