// The steps of an update on the CPU, each a few calls of the kernels in use.
#include <algorithm>
#include <array>
#include <cstring>

#include "sdk/src/character/instance_views.h"
#include "sdk/src/character/scene.h"
#include "sdk/src/core/half.h"

namespace nook {
namespace {

// Leaves what casters add in optical_depth, which then is no depth any more.
void evaluate_composed(const Scene& scene, const Instance& instance, const PointLanes& points) {
  const KeyPointSoa surface = surface_points(points);
  std::fill_n(points.optical_depth, points.padded_count, 0.0f);
  std::fill_n(points.open, points.padded_count, 1.0f);
  for (const std::uint32_t caster : instance.plan.casters)
    scene.kernels->composed_depth(caster_spheres(scene, instance, scene.instances[caster]), surface,
                                  points.optical_depth);
  for_free_spheres(scene, instance, [&](const SphereSoa& spheres) {
    scene.kernels->exact_open(spheres, surface, points.open);
  });
  scene.kernels->composed_occlusion(points.optical_depth, points.open, points.padded_count,
                                    points.optical_depth);
}

void join_paper_norm(const Scene& scene, const Instance& instance, const PointLanes& points) {
  const Kernel& kernel = instance.model->model.kernel;
  for (const std::uint32_t caster : instance.plan.casters)
    scene.kernels->self_norm_sum(spheres_of(scene.instances[caster], instance.plan.level),
                                 fitted_points(points), kernel, points.norm_sum);
  for_free_spheres(scene, instance, [&](const SphereSoa& spheres) {
    scene.kernels->self_norm_sum(spheres, fitted_points(points), kernel, points.norm_sum);
  });
  std::fill_n(points.optical_depth, points.padded_count, 0.0f);
}

std::uint64_t count_evaluations(const Scene& scene, const Instance& instance, std::uint32_t points) {
  std::uint64_t spheres =
      (has_self_shadow(scene, instance) ? spheres_of(instance, instance.plan.level).count : 0) +
      instance.plan.occluders.size() + (instance.plan.ground_sphere.radius > 0);
  for (const std::uint32_t caster : instance.plan.casters)
    spheres += caster_spheres(scene, instance, scene.instances[caster]).count;
  return spheres * points;
}

// From the evaluated key points to all of them. Scale and offset belong to self-shadow.
void spread_level(const CharacterLevel& level, bool with_self, const PointLanes& points) {
  for (std::uint32_t k = 0; k < points.count; ++k) {
    const std::uint16_t source = level.source[k];
    points.shadow[k] = with_self ? std::max(level.scale[k] * points.norm_sum[source] + level.offset[k], 0.0f)
                                 : points.norm_sum[source];
    points.added[k] = points.optical_depth[source];
  }
}

}  // namespace

void transform_spheres(const Scene& scene, Instance& instance) noexcept {
  if (instance.result.transformed_revision == instance.input.pose_revision) return;
  const auto transform = [&](const RestSpheres& rest, const SphereLanes& s) {
    scene.kernels->pose_spheres(rest.view(), instance.input.bones.data(), {},
                                {s.x, s.y, s.z, s.inverse_radius});
  };
  transform(instance.model->rest_spheres, instance.result.arrays.spheres);
  for (std::size_t l = 0; l < instance.model->levels.size(); ++l)
    transform(instance.model->levels[l].rest_spheres, instance.result.arrays.coarse_spheres[l]);
  instance.result.transformed_revision = instance.input.pose_revision;
}

void group_spheres(const Scene& scene, Instance& instance) noexcept {
  const bool may_darken = scene.nearest > 0 || !instance.input.receivers.empty();
  if (!may_darken || !may_group(scene)) return;
  if (instance.result.grouped_revision == instance.input.pose_revision) return;
  SphereSoa parts = spheres_of(instance, 0);
  const float* moments = nullptr;
  for (std::uint32_t t = 0; t < group_tiers; ++t) {
    const GroupLanes& groups = instance.result.arrays.groups[t];
    merge_groups(instance.model->groups.tier(t), parts, moments, groups);
    moments = groups.moment;
    parts = {groups.x, groups.y, groups.z, groups.inverse_radius, groups.caster_weight, groups.count};
  }
  instance.result.grouped_revision = instance.input.pose_revision;
}

void transform_key_points(const Scene& scene, Instance& instance) noexcept {
  const PointLanes& p = instance.result.arrays.points;
  const KeyPointTarget fitted{p.x, p.y, p.z, p.nx, p.ny, p.nz};
  const KeyPointTarget surface{p.surface_x,  p.surface_y,  p.surface_z,
                               p.surface_nx, p.surface_ny, p.surface_nz};
  const bool composed = scene.settings.combine == NOOK_COMBINE_COMPOSED;
  scene.kernels->pose_key_points(rest_points_of(instance).view(), instance.input.bones.data(), {}, fitted,
                                 composed ? &surface : nullptr);
  if (may_group(scene) && !instance.plan.casters.empty()) {
    const PointLanes points = evaluated_points(instance);
    instance.result.box = box_of(points.surface_x, points.surface_y, points.surface_z, points.count);
  }
}

void evaluate_shadows(const Scene& scene, Instance& instance) noexcept {
  const PointLanes points = evaluated_points(instance);
  const Kernel& kernel = instance.model->model.kernel;
  std::fill_n(points.norm_sum, points.padded_count, 0.0f);
  if (has_self_shadow(scene, instance))
    scene.kernels->self_norm_sum(spheres_of(instance, instance.plan.level), fitted_points(points), kernel,
                                 points.norm_sum);
  if (scene.settings.combine == NOOK_COMBINE_COMPOSED)
    evaluate_composed(scene, instance, points);
  else
    join_paper_norm(scene, instance, points);
  if (instance.plan.level == 0) {
    scene.kernels->norm_root(points.norm_sum, points.padded_count, kernel.gamma, points.shadow);
    std::copy_n(points.optical_depth, points.padded_count, points.added);
  } else {
    scene.kernels->norm_root(points.norm_sum, points.padded_count, kernel.gamma, points.norm_sum);
    spread_level(instance.model->model.levels[instance.plan.level - 1], has_self_shadow(scene, instance),
                 instance.result.arrays.points);
  }
  instance.result.evaluations = count_evaluations(scene, instance, points.count);
  instance.result.evaluated_frame = scene.frame;
}

void update(Scene& scene) noexcept {
  ++scene.frame;
  resolve_casters(scene,
                  [&](std::uint32_t slot) { return scene.instances[slot].result.evaluated_frame > 0; });
  const auto slots = static_cast<std::uint32_t>(scene.instances.size());
  auto transform = [&](std::uint32_t slot) noexcept {
    Instance& instance = scene.instances[slot];
    if (instance.id == 0) return;
    transform_spheres(scene, instance);
    group_spheres(scene, instance);
    if (instance.plan.due) transform_key_points(scene, instance);
  };
  parallel_for(scene.parallel, slots, transform);
  auto evaluate = [&](std::uint32_t slot) noexcept {
    Instance& instance = scene.instances[slot];
    if (instance.id == 0 || !instance.plan.due) return;
    evaluate_shadows(scene, instance);
    evaluate_directional(scene, instance);
  };
  parallel_for(scene.parallel, slots, evaluate);

  scene.stats = {};
  scene.stats.instances = scene.living;
  for (const Instance& instance : scene.instances) {
    if (instance.id == 0 || !instance.plan.due) continue;
    ++scene.stats.instances_updated;
    scene.stats.links += static_cast<std::uint32_t>(instance.plan.casters.size());
    scene.stats.links_culled += instance.plan.culled;
    scene.stats.evaluations += instance.result.evaluations;
  }
}

namespace {

// The AO of the instance itself.
enum class Self { none, shadow, clip };

Self self_of(const Scene& scene, const Instance& instance) {
  if (!(scene.terms & NOOK_TERM_SELF)) return Self::none;
  return instance.input.clip.is_used() ? Self::clip : Self::shadow;
}

constexpr std::uint32_t chunk_slots = LoadedModel::slot_chunk,
                        chunk_blocks = chunk_slots / linear_block_vertices;
static_assert(LoadedClips::block_slots % chunk_slots == 0);
using ChunkAo = std::array<float, chunk_slots>;

// Calls evaluate(layer, first_slot) for each chunk of the model's linear layer, then put(place, slot) for its
// file vertices, place being a pointer stride_bytes further for each and the slot that within the chunk.
template <class Evaluate, class Put>
void for_each_chunk(const LoadedModel& loaded, const float* open_bias, void* out, std::size_t stride_bytes,
                    Evaluate&& evaluate, Put&& put) noexcept {
  const LinearView& view = loaded.linear.view();
  auto* const bytes = static_cast<unsigned char*>(out);
  for (std::uint32_t block = 0; block < view.block_count; block += chunk_blocks) {
    const std::uint32_t first_slot = block * linear_block_vertices;
    const LinearView chunk{view.blocks + block, std::min(chunk_blocks, view.block_count - block),
                           view.key_point,      view.alpha,
                           view.blend,          open_bias + first_slot};
    evaluate(chunk, first_slot);
    const std::uint32_t end = first_slot + chunk.block_count * linear_block_vertices;
    const std::uint32_t last = loaded.slot_begin[end];
    for (std::uint32_t i = loaded.slot_begin[first_slot]; i < last; ++i)
      put(bytes + loaded.slot_file_vertex[i] * stride_bytes, loaded.slot_in_chunk[i]);
  }
}

// Fills the part of own that the chunk has.
void decode_clip(const Instance& instance, const LinearView& chunk, std::uint32_t first_slot, ChunkAo& own) {
  const InstanceClip& clip = instance.input.clip;
  decode_ao(*clip.clips, clip.weights.data(), first_slot, chunk.block_count * linear_block_vertices,
            own.data());
}

const float* open_bias_of(const LoadedModel& loaded, Self self) {
  return self == Self::shadow ? loaded.linear.view().open_bias : loaded.open_without_bias.data();
}

// Calls put(place, ao) for each file vertex, place being a pointer stride_bytes further for each.
template <class Put>
void for_each_ao(const Scene& scene, const Instance& instance, void* out, std::size_t stride_bytes,
                 Put&& put) noexcept {
  const LoadedModel& loaded = *instance.model;
  auto* const bytes = static_cast<unsigned char*>(out);
  if (instance.result.evaluated_frame == 0) {
    for (std::size_t i = 0; i < loaded.model.file_to_welded.size(); ++i) put(bytes + i * stride_bytes, 1.0f);
    return;
  }
  const Self self = self_of(scene, instance);
  const PointLanes& points = instance.result.arrays.points;
  const float* const added = scene.settings.combine == NOOK_COMBINE_COMPOSED ? points.added : nullptr;
  alignas(64) ChunkAo ao{}, own{};
  for_each_chunk(
      loaded, open_bias_of(loaded, self), out, stride_bytes,
      [&](const LinearView& chunk, std::uint32_t first_slot) {
        scene.kernels->linear_layer(chunk, points.shadow, added, ao.data());
        if (self != Self::clip) return;
        decode_clip(instance, chunk, first_slot, own);
        for (std::uint32_t i = 0; i < chunk_slots; ++i) ao[i] *= own[i];
      },
      [&](unsigned char* place, std::uint32_t slot) { put(place, ao[slot]); });
}

void put_float(unsigned char* place, float ao) noexcept {
  std::memcpy(place, &ao, sizeof ao);
}

}  // namespace

void read_ao(const Scene& scene, const Instance& instance, float* out, std::size_t stride_bytes) noexcept {
  for_each_ao(scene, instance, out, stride_bytes, put_float);
}

void read_ao_as(const Scene& scene, const Instance& instance, nook_ao_format format, void* out,
                std::size_t stride_bytes) noexcept {
  switch (format) {
    case NOOK_AO_HALF:
      return for_each_ao(scene, instance, out, stride_bytes, [](unsigned char* place, float ao) {
        const std::uint16_t half = to_half(ao);
        std::memcpy(place, &half, sizeof half);
      });
    case NOOK_AO_UNORM8:
      return for_each_ao(scene, instance, out, stride_bytes, [](unsigned char* place, float ao) {
        *place = static_cast<unsigned char>(ao * 255 + 0.5f);
      });
    default:
      return for_each_ao(scene, instance, out, stride_bytes, put_float);
  }
}

void read_directional_ao(const Scene& scene, const Instance& instance, float* out,
                         std::size_t stride_bytes) noexcept {
  const auto put_three = [](unsigned char* place, float r, float g, float b) {
    const float rgb[] = {r, g, b};
    std::memcpy(place, rgb, sizeof rgb);
  };
  const InstanceLight& light = instance.light;
  if (!light.evaluated)
    return for_each_ao(scene, instance, out, stride_bytes,
                       [&](unsigned char* place, float ao) { put_three(place, ao, ao, ao); });
  const LoadedModel& loaded = *instance.model;
  const bool composed = scene.settings.combine == NOOK_COMBINE_COMPOSED;
  const Self self = self_of(scene, instance);
  alignas(64) std::array<ChunkAo, 3> ao{};
  alignas(64) ChunkAo own{};
  float* const rgb[] = {ao[0].data(), ao[1].data(), ao[2].data()};
  for_each_chunk(
      loaded, open_bias_of(loaded, self), out, stride_bytes,
      [&](const LinearView& chunk, std::uint32_t first_slot) {
        scene.kernels->directional_linear_layer(chunk, instance.result.arrays.points.shadow, light.shadow,
                                                composed ? light.added : nullptr, rgb);
        if (self != Self::clip) return;
        decode_clip(instance, chunk, first_slot, own);
        for (ChunkAo& channel : ao)
          for (std::uint32_t i = 0; i < chunk_slots; ++i) channel[i] *= own[i];
      },
      [&](unsigned char* place, std::uint32_t slot) {
        put_three(place, ao[0][slot], ao[1][slot], ao[2][slot]);
      });
}

}  // namespace nook
