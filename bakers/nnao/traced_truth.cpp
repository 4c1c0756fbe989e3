#include "nnao/traced_truth.h"

#include <algorithm>

#include "raytrace/ambient_occlusion.h"

namespace nook::bake::nnao {
namespace {

// As in the training set: far above the rounding of hits a few metres away, far below any thing.
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
  TrainingScene scene;
  // Few triangles may span a scene; their vertices still bound it.
  std::vector<float> axis[3];
  for (const Vec3 p : soup.position) {
    axis[0].push_back(p.x);
    axis[1].push_back(p.y);
    axis[2].push_back(p.z);
  }
  const auto part = [&](float from, float to) {
    const auto at = [&](std::vector<float>& values, float share) {
      const auto nth = values.begin() + std::ptrdiff_t(share * float(values.size() - 1));
      std::nth_element(values.begin(), nth, values.end());
      return *nth;
    };
    return Box{{at(axis[0], from), at(axis[1], from), at(axis[2], from)},
               {at(axis[0], to), at(axis[1], to), at(axis[2], to)}};
  };
  // Single far vertices (a sky, a ground) must not decide.
  scene.cameras = part(0.02f, 0.98f);
  scene.subject = part(0.1f, 0.9f);
  scene.soup = std::move(soup);
  return scene;
}

}  // namespace nook::bake::nnao
