#include "sdk/src/character/instance_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "sdk/src/character/instance_views.h"
#include "sdk/src/core/failure.h"

namespace nook {
namespace {

constexpr float max_sharpness = 1e4f, max_amplitude = 1e18f;

void check_lobe(const SphericalGaussian& lobe, std::size_t index) {
  if (!(std::abs(length(lobe.axis) - 1) <= 1e-3f))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the axis of lobe %zu is not of unit length (got %g, need 1 within 0.001)", index,
                  double(length(lobe.axis)));
  if (!(lobe.sharpness >= 0 && lobe.sharpness <= max_sharpness))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the sharpness of lobe %zu is out of range (got %g, need 0 to 10,000)", index,
                  double(lobe.sharpness));
  for (const float channel : {lobe.amplitude.x, lobe.amplitude.y, lobe.amplitude.z})
    if (!(std::abs(channel) <= max_amplitude))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "the amplitude of lobe %zu is out of range (got %g, need at most 1e18 in magnitude)",
                    index, double(channel));
}

// Takes ownership of the storage, and points the lanes into it.
void take_storage(InstanceLight& light, AlignedArray<float> storage) {
  light.storage = std::move(storage);
  const std::size_t length = light.storage.size() / light_lanes;
  float* at = light.storage.data();
  for (auto lanes : {&light.shadow, &light.added, &light.sum, &light.open, &light.inverse})
    for (float*& lane : *lanes) {
      lane = at;
      at += length;
    }
}

AlignedArray<float> make_storage(const LoadedModel& model, Memory* memory) {
  return AlignedArray<float>(std::size_t{light_lanes} * model.rest_key_points.padded_count(), memory);
}

void allocate(InstanceLight& light, const Scene& scene, const LoadedModel& model) {
  AlignedArray<LightLobe> lobes(max_light_lobes, scene.memory);
  AlignedArray<LobeBands> lobe_bands(max_light_lobes, scene.memory);
  if (scene.has_arrays) take_storage(light, make_storage(model, scene.memory));
  light.lobes = std::move(lobes);
  light.lobe_bands = std::move(lobe_bands);
}

void fill(float* const* lanes, std::uint32_t count, float value) {
  for (int c = 0; c < 3; ++c) std::fill_n(lanes[c], count, value);
}

// Inverts norm_root. For the norm n and the saturation c, the relative error is 6e-8 (1 + c n). The result is
// at most 1e6 / c.
float norm_sum_of(float shadow, float saturation, float gamma) {
  const float norm = shadow / std::max(1 - saturation * shadow, 1e-6f);
  return gamma == 1 ? norm : std::pow(norm, gamma);
}

// Computes the coloured shadow of all key points, shadow * (sum of y^gamma rho) / (sum of y^gamma). light.sum
// holds the first of these sums for the evaluated key points.
void colour_shadow(const Instance& instance, InstanceLight& light) {
  const PointLanes& points = instance.arrays().points;
  const float gamma = instance.model->model.kernel.gamma;
  const CharacterLevel* level =
      instance.plan.level ? &instance.model->model.levels[instance.plan.level - 1] : nullptr;
  const float* saturation = rest_points_of(instance).view().saturation;
  for (std::uint32_t k = 0; k < points.count; ++k) {
    const std::uint32_t source = level ? level->source[k] : k;
    // At a coarser level, the sums are no longer stored, so they are computed from the shadows.
    const float sum =
        level ? norm_sum_of(points.norm_sum[source], saturation[source], gamma) : points.norm_sum[source];
    const float scale = sum > 0 ? points.shadow[k] / sum : 0;
    for (int c = 0; c < 3; ++c) light.shadow[c][k] = light.sum[c][source] * scale;
  }
}

void spread_added(const Instance& instance, InstanceLight& light) {
  const CharacterLevel* level =
      instance.plan.level ? &instance.model->model.levels[instance.plan.level - 1] : nullptr;
  for (std::uint32_t k = 0; k < instance.arrays().points.count; ++k)
    for (int c = 0; c < 3; ++c) light.added[c][k] = light.sum[c][level ? level->source[k] : k];
}

void evaluate_composed(const Scene& scene, const Instance& instance, const PointLanes& points,
                       InstanceLight& light) {
  const KeyPointSoa surface = surface_points(points);
  const LightView lobes = light.view();
  fill(light.sum, points.padded_count, 0.0f);
  fill(light.open, points.padded_count, 1.0f);
  if (!instance.plan.casters.empty() || !instance.plan.occluders.empty())
    scene.kernels->directional_hemisphere(surface, lobes, light.inverse);
  for (const std::uint32_t caster : instance.plan.casters)
    scene.kernels->directional_depth(caster_spheres(scene, instance, scene.instances[caster]), surface, lobes,
                                     light.inverse, light.sum);
  for_ground(instance, [&](const SphereSoa& ground) {
    scene.kernels->directional_ground(ground, surface, lobes, instance.input.ground.normal, light.open);
  });
  for_occluders(scene, instance, [&](const SphereSoa& spheres) {
    scene.kernels->directional_open(spheres, surface, lobes, light.inverse, light.open);
  });
  for (int c = 0; c < 3; ++c)
    scene.kernels->composed_occlusion(light.sum[c], light.open[c], points.padded_count, light.sum[c]);
  spread_added(instance, light);
}

// In the paper's form, a single norm sums the spheres of the body and of its casters.
void join_paper_norm(const Scene& scene, const Instance& instance, const PointLanes& points,
                     InstanceLight& light) {
  const auto join = [&](const SphereSoa& spheres) {
    scene.kernels->directional_norm_sum(spheres, fitted_points(points), instance.model->model.kernel,
                                        light.bands, light.sum);
  };
  for (const std::uint32_t caster : instance.plan.casters)
    join(spheres_of(scene.instances[caster], instance.plan.level));
  for_free_spheres(scene, instance, join);
}

}  // namespace

void check_light_lobes(std::span<const SphericalGaussian> lobes) {
  if (lobes.size() > max_light_lobes)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "lobe_count is too large (got %zu, need at most %u)",
                  lobes.size(), max_light_lobes);
  for (std::size_t i = 0; i < lobes.size(); ++i) check_lobe(lobes[i], i);
}

void set_light(Scene& scene, nook_instance_id id, std::span<const SphericalGaussian> lobes) {
  Instance& instance = instance_of(scene, id);
  check_light_lobes(lobes);
  if (scene.pool.is_used()) {
    if (lobes.empty()) return;
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the scene has a pool, whose instances cannot have lights; use a scene without a pool for "
                  "instance %u",
                  id);
  }
  InstanceLight& light = instance.parts->light;
  if (!lobes.empty() && light.lobes.size() == 0) {
    allocate(light, scene, *instance.model);
    ++scene.structure_revision;
  }
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    light.lobes[i] = {lobes[i].axis * lobes[i].sharpness, lobes[i].sharpness, lobes[i].amplitude, 1};
    light.lobe_bands[i] = bands_of(lobes[i].sharpness);
  }
  // Distant instances are evaluated in turns. When such an instance gets its first light, it is evaluated in
  // the next update, without waiting for its turn.
  if (light.count == 0 && !lobes.empty()) instance.result.evaluated_frame = 0;
  light.count = static_cast<std::uint32_t>(lobes.size());
  light.darkest = darkest_of(lobes);
  if (lobes.empty()) light.evaluated = false;
}

void make_light_arrays(const Scene& scene, Instance& instance) {
  InstanceLight& light = instance.parts->light;
  if (light.lobes.size()) take_storage(light, make_storage(*instance.model, scene.memory));
}

void leave_light_arrays(Instance& instance) noexcept {
  take_storage(instance.parts->light, {});
}

InstanceLight moved_light(const Scene& scene, const InstanceLight& light, const LoadedModel& model) {
  InstanceLight moved;
  if (light.lobes.size() == 0) return moved;
  allocate(moved, scene, model);
  std::copy(light.lobes.begin(), light.lobes.end(), moved.lobes.begin());
  std::copy(light.lobe_bands.begin(), light.lobe_bands.end(), moved.lobe_bands.begin());
  moved.count = light.count;
  moved.darkest = light.darkest;
  return moved;
}

// In the paper's form, the ground is one of the spheres of the norm. The norm then accounts for the light
// that the ground removes, so the lobes are not reduced here.
void prepare_light(const Scene& scene, Instance& instance) noexcept {
  InstanceLight& light = instance.parts->light;
  const bool hides = instance.plan.ground_sphere.radius > 0 && scene.settings.form == NOOK_FORM_DEFAULT;
  light.bands = {};
  light.bands.darkest = light.darkest;
  for (std::uint32_t i = 0; i < light.count; ++i) {
    LightLobe& lobe = light.lobes[i];
    lobe.above = hides ? 1 - share_below(dot(lobe.vector, instance.input.ground.normal), lobe.sharpness) : 1;
    const Vec3 axis = lobe.sharpness > 0 ? lobe.vector * (1 / lobe.sharpness) : Vec3{};
    add_lobe(light.bands, axis, lobe.amplitude * lobe.above, light.lobe_bands[i]);
  }
}

void evaluate_directional(const Scene& scene, Instance& instance) noexcept {
  InstanceLight& light = instance.parts->light;
  if (light.count == 0) return;
  prepare_light(scene, instance);
  const PointLanes points = evaluated_points(instance);
  const bool composed = scene.settings.form == NOOK_FORM_DEFAULT;
  fill(light.sum, points.padded_count, 0.0f);
  if (has_self_shadow(scene, instance))
    scene.kernels->directional_norm_sum(spheres_of(instance, instance.plan.level), fitted_points(points),
                                        instance.model->model.kernel, light.bands, light.sum);
  if (!composed) join_paper_norm(scene, instance, points, light);
  colour_shadow(instance, light);
  if (composed) evaluate_composed(scene, instance, points, light);
  light.evaluated = true;
}

}  // namespace nook
