#include "bakers/nnao/dataset.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <mutex>

#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::nnao {
namespace {

constexpr float min_radius = 0.08f, max_radius = 1.6f;  // metres
constexpr float min_radius_px = 4;
// The distance of ray origins from the surface, metres. It is far above the rounding of hits a few metres
// away, and far below the size of objects in the scenes.
constexpr float origin_offset = 3e-4f;

// Every sixth round of the families is for validation, or the last one if there are fewer rounds.
bool is_validation(std::uint32_t scene, std::uint32_t scenes) {
  const std::uint32_t rounds = scenes / family_count;
  return scene / family_count % 6 == std::min(rounds - 1, 5u);
}

void check(const DatasetSettings& settings) {
  if (settings.scenes < 2 * family_count)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "too few scenes (got %u, need at least %u, two of each family)", settings.scenes,
                  2 * family_count);
  if (settings.views < settings.scenes)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "too few views (got %u, need at least one a scene, %u)",
                  settings.views, settings.scenes);
  if (settings.points_per_view < 1 || settings.rays < 1 || settings.width < 16 || settings.height < 16)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "the data set is empty (got %u points a view, %u rays, %u x %u pixels, need at least 1, 1, 16 x 16)",
        settings.points_per_view, settings.rays, settings.width, settings.height);
}

}  // namespace

std::vector<DataPoint> trace_points(const RayScene& rays, const TracedView& view, std::uint32_t view_index,
                                    std::uint32_t points, std::uint32_t ray_count, std::uint64_t seed) {
  Random random(seed);
  std::vector<DataPoint> chosen;
  std::vector<Vec3> position_ws, normal_ws;
  std::vector<float> radius;
  const Camera& camera = view.camera;
  for (std::uint32_t i = 0; i < points; ++i) {
    DataPoint point;
    point.view = view_index;
    point.x = std::uint16_t(random.below(camera.width));
    point.y = std::uint16_t(random.below(camera.height));
    const float wanted = random.log_between(min_radius, max_radius);
    const std::size_t at = std::size_t(point.y) * camera.width + point.x;
    const float depth = view.depth[at];
    if (!std::isfinite(depth)) continue;
    const float px_per_metre = std::abs(nook::nnao::pixel_scale(camera.rays, depth).y);
    point.radius = std::clamp(wanted * px_per_metre, min_radius_px, Dataset::max_radius_px) / px_per_metre;
    point.normal = view.normal[at];
    chosen.push_back(point);
    const PixelRay ray = pixel_ray(camera, float(point.x) + 0.5f, float(point.y) + 0.5f);
    position_ws.push_back(ray.origin_ws + depth * ray.direction_ws);
    normal_ws.push_back(transform_vector(camera.world_from_view, point.normal));
    radius.push_back(point.radius);
  }
  AoSettings ao;
  ao.rays = ray_count;
  ao.seed = seed;
  ao.origin_offset = origin_offset;
  const std::vector<float> traced = trace_ao(rays, {position_ws, normal_ws, radius}, ao);
  for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i].ao = traced[i];
  return chosen;
}

Dataset make_dataset(const DatasetSettings& settings, const DatasetProgress& progress) {
  check(settings);
  Dataset data;
  data.views.resize(settings.views);
  std::vector<std::vector<DataPoint>> points(settings.views);
  std::atomic<bool> cancelled{false};
  std::mutex progress_mutex;
  std::size_t done = 0;
  tbb::parallel_for(std::uint32_t(0), settings.scenes, [&](std::uint32_t s) {
    if (cancelled) return;
    const TrainingScene scene = make_scene(settings.seed, s);
    const RayScene rays(scene.soup);
    for (std::uint32_t v = s; v < settings.views; v += settings.scenes) {
      const std::uint64_t seed = mix_bits(settings.seed ^ mix_bits(v));
      Random random(seed);
      const Camera camera = place_camera(rays, scene, random, settings.width, settings.height);
      data.views[v] = trace_view(rays, camera);
      points[v] = trace_points(rays, data.views[v], v, settings.points_per_view, settings.rays, seed);
      if (!settings.normals) data.views[v].normal = {};
    }
    if (!progress) return;
    const std::lock_guard lock(progress_mutex);
    if (!progress(++done, settings.scenes)) cancelled = true;
  });
  if (cancelled) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while ray tracing the training set");
  for (std::uint32_t v = 0; v < settings.views; ++v) {
    auto& part = is_validation(v % settings.scenes, settings.scenes) ? data.validation : data.training;
    part.insert(part.end(), points[v].begin(), points[v].end());
  }
  return data;
}

}  // namespace nook::bake::nnao
