#include "bakers/nnao/dataset.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>

#include "bakers/nnao/cameras.h"
#include "bakers/nnao/host_normals.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::nnao {
namespace {

// Returns a random radius in metres. `px_per_metre` is the number of pixels that one metre covers at the
// point.
float any_radius(Random& random, float px_per_metre) {
  constexpr float low_px = Dataset::min_radius_px, high_px = Dataset::max_radius_px;
  const bool in_metres = random.chance(0.5f);
  const float metres = random.log_between(0.05f, 2.5f), px = random.log_between(low_px, high_px);
  const float limit_px = random.log_between(40, high_px);
  if (!in_metres) return px / px_per_metre;
  return std::clamp(metres * px_per_metre, low_px, limit_px) / px_per_metre;
}

// Returns true if the screen shows a single plane around a point. Such points are easy to predict. The test
// reads only what the network sees, so that skipping points does not change the mean AO of equal inputs.
bool is_flat(const TracedView& view, const DataPoint& point, float radius_px) {
  const Camera& camera = view.camera;
  const auto position = [&](std::uint32_t x, std::uint32_t y) {
    return nook::nnao::view_position(camera.rays, float(x) + 0.5f, float(y) + 0.5f,
                                     view.depth[std::size_t(y) * camera.width + x]);
  };
  const Vec3 middle = position(point.x, point.y);
  for (int i = 0; i < 16; ++i) {
    const float angle = 0.7853982f * float(i % 8), reach = radius_px * (i < 8 ? 0.3f : 0.8f);
    const int x = int(std::lround(float(point.x) + reach * std::cos(angle)));
    const int y = int(std::lround(float(point.y) + reach * std::sin(angle)));
    if (x < 0 || y < 0 || x >= int(camera.width) || y >= int(camera.height)) continue;
    const Vec3 away = position(std::uint32_t(x), std::uint32_t(y)) - middle;
    if (!(std::abs(dot(away, point.normal)) < 0.03f * point.radius)) return false;
  }
  return true;
}

// Draws a pixel and its radius. Returns nothing if the pixel shows the sky, or if it is flat and is rejected
// at random.
std::optional<DataPoint> any_point(const TracedView& view, Random& random) {
  const Camera& camera = view.camera;
  DataPoint point;
  point.x = std::uint16_t(random.below(camera.width));
  point.y = std::uint16_t(random.below(camera.height));
  const std::size_t at = std::size_t(point.y) * camera.width + point.x;
  const float depth = view.depth[at];
  if (!std::isfinite(depth)) return {};
  const float px_per_metre = std::abs(nook::nnao::pixel_scale(camera.rays, depth).y);
  point.radius = any_radius(random, px_per_metre);
  point.normal = view.normal[at];
  if (is_flat(view, point, point.radius * px_per_metre) && !random.chance(Dataset::flat_share)) return {};
  return point;
}

// Every sixth round through the families is used for validation. With fewer than six rounds, it is the last
// one.
bool is_validation(std::uint32_t scene, std::uint32_t scenes) {
  const std::uint32_t rounds = scenes / family_count;
  return scene / family_count % 6 == std::min(rounds - 1, 5u);
}

void check(const DatasetSettings& settings) {
  if (settings.scenes < 2 * family_count)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "too few scenes (got %u, need at least %u: two for each family)", settings.scenes,
                  2 * family_count);
  if (settings.views < settings.scenes)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "too few views (got %u, need at least one per scene: %u)",
                  settings.views, settings.scenes);
  if (settings.points_per_view < 1 || settings.rays < 1 || settings.width < 16 || settings.height < 16)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the data set is empty (got %u points per view, %u rays and %u x %u pixels; need at least "
                  "1 point, 1 ray and 16 x 16 pixels)",
                  settings.points_per_view, settings.rays, settings.width, settings.height);
  if (!(settings.host_normal_share >= 0 && settings.host_normal_share <= 1))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the share of host normals is out of range (got %g, need 0 to 1)",
                  double(settings.host_normal_share));
}

}  // namespace

float origin_offset(Vec3 position, float depth, float radius) {
  const float reach = std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z), depth});
  return std::max(std::min(3e-4f, 0.01f * radius), 3e-6f * reach);
}

std::vector<DataPoint> trace_points(const RayScene& rays, const TracedView& view, std::uint32_t view_index,
                                    std::uint32_t points, std::uint32_t ray_count, std::uint64_t seed) {
  Random random(seed);
  std::vector<DataPoint> chosen;
  std::vector<Vec3> position_ws, normal_ws;
  std::vector<float> radius, offset;
  const Camera& camera = view.camera;
  // A view that shows mostly sky gets fewer points.
  for (std::uint32_t tries = 3 * points; chosen.size() < points && tries > 0; --tries) {
    std::optional<DataPoint> found = any_point(view, random);
    if (!found) continue;
    DataPoint& point = *found;
    point.view = view_index;
    const float depth = view.depth[std::size_t(point.y) * camera.width + point.x];
    chosen.push_back(point);
    const PixelRay ray = pixel_ray(camera, float(point.x) + 0.5f, float(point.y) + 0.5f);
    position_ws.push_back(ray.origin_ws + depth * ray.direction_ws);
    normal_ws.push_back(transform_vector(camera.world_from_view, point.normal));
    radius.push_back(point.radius);
    offset.push_back(origin_offset(position_ws.back(), depth, point.radius));
  }
  AoSettings ao;
  ao.rays = ray_count;
  ao.seed = seed;
  const Openness open = trace_openness(rays, {position_ws, normal_ws, radius, offset}, ao);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    chosen[i].ao = open.ao[i];
    chosen[i].open_direction = view_direction(camera, open.direction[i]);
  }
  return chosen;
}

namespace {

// Replaces the normals of a view and of its points by host-like normals.
void set_host_normals(const HostNormals& normals, const RayScene& rays, bool all_pixels, TracedView& view,
                      std::vector<DataPoint>& points) {
  const FlushDenormals flush;
  const Camera& camera = view.camera;
  const auto normal_at = [&](std::uint32_t x, std::uint32_t y) {
    const PixelRay ray = pixel_ray(camera, float(x) + 0.5f, float(y) + 0.5f);
    const RayHit hit = rays.nearest(ray.origin_ws, ray.direction_ws);
    if (!std::isfinite(hit.distance)) return Vec3{};
    return view_direction(camera, normals.at(hit, ray.origin_ws, ray.direction_ws));
  };
  for (DataPoint& point : points) point.normal = normal_at(point.x, point.y);
  for (std::uint32_t y = 0; all_pixels && y < camera.height; ++y)
    for (std::uint32_t x = 0; x < camera.width; ++x)
      view.normal[std::size_t(y) * camera.width + x] = normal_at(x, y);
}

}  // namespace

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
      const Camera camera = place_training_camera(rays, scene, random, settings.width, settings.height);
      data.views[v] = trace_view(rays, camera);
      points[v] = trace_points(rays, data.views[v], v, settings.points_per_view, settings.rays, seed);
      if (Random(mix_bits(~seed)).chance(settings.host_normal_share))
        set_host_normals(HostNormals(scene.soup, scene.size, seed), rays, settings.normals, data.views[v],
                         points[v]);
      // Assigning {} would not free the memory.
      if (!settings.normals) data.views[v].normal = std::vector<Vec3>();
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
