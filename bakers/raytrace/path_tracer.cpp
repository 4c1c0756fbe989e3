#include "bakers/raytrace/path_tracer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/spherical_gaussian.h"

namespace nook::bake {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr std::uint32_t certain_bounces = 3;   // number of bounces before Russian roulette starts
constexpr float most_likely_survival = 0.95f;  // below 1, so that paths between white walls end

float largest(Vec3 v) {
  return std::max({v.x, v.y, v.z});
}
bool is_black(Vec3 v) {
  return v.x == 0 && v.y == 0 && v.z == 0;
}

Vec3 direct_radiance(const LitScene& scene, Vec3 radiance, DirectLight direct) {
  switch (direct) {
    case DirectLight::none:
      return {};
    case DirectLight::sky:
      return without_sun(radiance, scene.sun_limit());
    case DirectLight::all:
      break;
  }
  return radiance;
}

// Samples a direction by luminance, and returns the irradiance that the environment's light from there gives
// a surface. The balance heuristic (Veach 1997) combines this sample with cosine-weighted samples.
Vec3 light_by_luminance(const LitScene& scene, Vec3 origin, Vec3 normal, DirectLight direct, Random& random) {
  const double choice = random.unit_double();
  const float alias = random.unit(), u = random.unit(), v = random.unit();
  const LightSample light = scene.light().sample(choice, alias, u, v);
  const float cosine = dot(light.direction, normal);
  const Vec3 radiance = direct_radiance(scene, light.radiance, direct);
  if (cosine <= 0 || is_black(radiance) || scene.occluded(origin, light.direction)) return {};
  return radiance * (cosine / (light.density + cosine / pi));
}

// Estimates the irradiance at a point with one path that starts along `direction`. `direction` must be a
// cosine-weighted sample.
Vec3 irradiance_path(const LitScene& scene, Vec3 position, Vec3 normal, Vec3 direction,
                     const PathSettings& settings, Random& random) {
  Vec3 irradiance, share{1, 1, 1};
  for (std::uint32_t bounce = 0;; ++bounce) {
    const Vec3 origin = position + settings.origin_offset * normal;
    const DirectLight direct = bounce == 0 ? settings.direct : DirectLight::all;
    irradiance += by_channel(share, light_by_luminance(scene, origin, normal, direct, random));
    const RayHit hit = scene.nearest(origin, direction);
    if (std::isinf(hit.distance)) {
      const float density = std::max(dot(direction, normal), 0.0f) / pi;
      if (density > 0)
        irradiance +=
            by_channel(share, direct_radiance(scene, scene.environment().radiance(direction), direct)) *
            (pi * density / (density + scene.light().density(direction)));
      return irradiance;
    }
    const SurfaceColours surface = scene.colours(hit);
    irradiance += pi * by_channel(share, surface.emission);
    // A cosine-weighted direction contributes pi times its radiance, and a diffuse surface reflects
    // irradiance * base colour / pi.
    share = by_channel(share, surface.base_colour);
    if (bounce >= settings.max_bounces || is_black(share)) return irradiance;
    if (bounce >= certain_bounces) {
      const float survival = std::min(largest(share), most_likely_survival);
      if (random.unit() >= survival) return irradiance;
      share = share * (1 / survival);
    }
    position = origin + hit.distance * direction;
    normal = hit.normal;
    const float u = random.unit(), v = random.unit();
    direction = to_world(turned_frame(normal, 1, 0), cosine_direction(u, v));
  }
}

}  // namespace

const std::vector<std::string>& direct_names() {
  static const std::vector<std::string> names{"none", "sky", "all"};
  return names;
}

DirectLight direct_of(const std::string& name) {
  return DirectLight(std::ranges::find(direct_names(), name) - direct_names().begin());
}

Vec3 trace_radiance(const LitScene& scene, Vec3 origin, Vec3 direction, const PathSettings& settings,
                    Random& random) {
  const RayHit hit = scene.nearest(origin, direction);
  if (std::isinf(hit.distance))
    return direct_radiance(scene, scene.environment().radiance(direction), settings.direct);
  const SurfaceColours surface = scene.colours(hit);
  if (settings.max_bounces == 0 || is_black(surface.base_colour)) return surface.emission;
  PathSettings rest = settings;
  rest.direct = DirectLight::all;
  if (rest.max_bounces != ~0u) --rest.max_bounces;
  const float u = random.unit(), v = random.unit();
  const Vec3 onward = to_world(turned_frame(hit.normal, 1, 0), cosine_direction(u, v));
  const Vec3 irradiance =
      irradiance_path(scene, origin + hit.distance * direction, hit.normal, onward, rest, random);
  return surface.emission + by_channel(surface.base_colour, irradiance) * (1 / pi);
}

std::vector<Vec3> trace_irradiance(const LitScene& scene, const Receivers& receivers,
                                   const IrradianceSettings& settings, const Progress& progress) {
  const HemispherePatterns patterns(settings.rays, settings.seed);
  std::vector<Vec3> irradiance(receivers.position.size());
  std::atomic<bool> cancelled{false};
  std::mutex progress_mutex;
  std::size_t done = 0;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, irradiance.size(), receivers_per_task(settings.rays)),
      [&](const auto& range) {
        if (cancelled) return;
        const FlushDenormals flush;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const std::uint64_t key = mix_bits(settings.seed ^ mix_bits(i));
          const float angle = 2 * pi * unit_float(key);
          const Frame frame = turned_frame(receivers.normal[i], std::cos(angle), std::sin(angle));
          Random random(key);
          Vec3 sum;
          for (std::uint32_t r = 0; r < settings.rays; ++r)
            sum += irradiance_path(scene, receivers.position[i], receivers.normal[i],
                                   to_world(frame, patterns.pattern(std::uint32_t(key))[r]), settings.path,
                                   random);
          irradiance[i] = sum * (1 / float(settings.rays));
        }
        if (progress) {
          const std::lock_guard lock(progress_mutex);
          done += range.size();
          if (!progress(done, irradiance.size())) cancelled = true;
        }
      },
      tbb::simple_partitioner());
  if (cancelled)
    throw Failure(NOOK_ERROR_CANCELLED, "cancelled while tracing light (%zu of %zu points done)", done,
                  irradiance.size());
  return irradiance;
}

}  // namespace nook::bake
