#include "bakers/lab/nnao/traced_truth.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/specular_visibility.h"

namespace nook::lab {

using namespace bake::nnao;
using namespace bake;

namespace {

// The training set uses the same value. It is far above the rounding errors of hits a few metres away, and
// far below the size of objects.
constexpr float origin_offset = 3e-4f;

struct Surfaces {
  std::vector<std::size_t> pixel;
  std::vector<Vec3> position, normal;  // world space
};

Surfaces surfaces_of(const TracedView& view, std::size_t every) {
  Surfaces found;
  const Camera& camera = view.camera;
  for (std::size_t i = 0; i < view.depth.size(); i += every) {
    if (!std::isfinite(view.depth[i])) continue;
    const PixelRay ray = pixel_ray(camera, float(i % camera.width) + 0.5f, float(i / camera.width) + 0.5f);
    found.pixel.push_back(i);
    found.position.push_back(ray.origin_ws + view.depth[i] * ray.direction_ws);
    found.normal.push_back(transform_vector(camera.world_from_view, view.normal[i]));
  }
  return found;
}

std::vector<float> trace(const RayScene& rays, const Surfaces& surfaces, float radius,
                         std::uint32_t ray_count, std::uint64_t seed) {
  AoSettings settings;
  settings.rays = ray_count;
  settings.seed = seed;
  settings.radius = radius;
  settings.origin_offset = origin_offset;
  return trace_ao(rays, {surfaces.position, surfaces.normal}, settings);
}

}  // namespace

std::vector<float> trace_truth(const RayScene& rays, const TracedView& view, float radius,
                               std::uint32_t ray_count, std::uint64_t seed) {
  const Surfaces surfaces = surfaces_of(view, 1);
  const std::vector<float> traced = trace(rays, surfaces, radius, ray_count, seed);
  std::vector<float> truth(view.depth.size(), 1.0f);
  for (std::size_t i = 0; i < traced.size(); ++i) truth[surfaces.pixel[i]] = traced[i];
  return truth;
}

double truth_noise(const RayScene& rays, const TracedView& view, float radius, std::uint32_t ray_count,
                   std::uint64_t seed) {
  const Surfaces surfaces = surfaces_of(view, 13);
  const std::vector<float> a = trace(rays, surfaces, radius, ray_count, seed);
  const std::vector<float> b = trace(rays, surfaces, radius, ray_count, mix_bits(~seed));
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += double(a[i] - b[i]) * double(a[i] - b[i]);
  return a.empty() ? 0 : 0.5 * sum / double(a.size());
}

Camera slid_by_one_pixel(Camera camera) {
  camera.rays.x_offset += camera.rays.x_scale;
  return camera;
}

TrainingScene scene_to_look_at(TriangleSoup soup) {
  // Most vertices belong to small objects, and most of the area belongs to backdrops. Half of the points are
  // therefore drawn from the vertices and half by area, so that objects of medium size are found too.
  std::vector<double> area_below;
  double area = 0;
  for (const auto& t : soup.triangle) {
    const Vec3 a = soup.position[t[0]], b = soup.position[t[1]], c = soup.position[t[2]];
    area_below.push_back(area += double(length(cross(b - a, c - a))));
  }
  std::vector<float> axis[3];
  bake::Random random(1);
  constexpr int points = 4000;
  for (int i = 0; i < points; ++i) {
    const double at = area * double(random.unit());
    const auto found = std::upper_bound(area_below.begin(), area_below.end(), at) - area_below.begin();
    const bool by_area = i % 2 == 0;
    const auto triangle = std::min(std::size_t(found), soup.triangle.size() - 1);
    const auto some = random.below(std::uint32_t(soup.triangle.size()));
    const auto& t = soup.triangle[by_area ? triangle : some];
    const Vec3 p = (1.0f / 3) * (soup.position[t[0]] + soup.position[t[1]] + soup.position[t[2]]);
    axis[0].push_back(p.x);
    axis[1].push_back(p.y);
    axis[2].push_back(p.z);
  }
  for (std::vector<float>& values : axis) std::sort(values.begin(), values.end());
  const auto part = [&](float from, float to) {
    const auto low = std::size_t(from * (points - 1)), high = std::size_t(to * (points - 1));
    return Box{{axis[0][low], axis[1][low], axis[2][low]}, {axis[0][high], axis[1][high], axis[2][high]}};
  };
  TrainingScene scene;
  scene.cameras = part(0.1f, 0.9f);
  scene.subject = part(0.3f, 0.7f);
  scene.soup = std::move(soup);
  return scene;
}

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

}  // namespace nook::lab
