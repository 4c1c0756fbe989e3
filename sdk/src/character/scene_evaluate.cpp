// The steps of an update on the CPU. Each step calls a few of the chosen kernels.
#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>

#include "sdk/src/character/instance_views.h"
#include "sdk/src/character/scene.h"
#include "sdk/src/character/scene_clips.h"
#include "sdk/src/core/floats.h"

namespace nook {
namespace {

// True if other instances may use this instance's spheres.
bool may_darken(const Scene& scene, const Instance& instance) {
  return scene.nearest > 0 || !instance.input.receivers.empty();
}

bool has_casters(const Instance& instance) {
  return !instance.plan.casters.empty() || free_sphere_count(instance) > 0;
}

// Computes the occlusion that the casters add. The computation overwrites optical_depth. Returns the number
// of spheres.
std::size_t evaluate_composed(const Scene& scene, const Instance& instance, const PointLanes& points) {
  const KeyPointSoa surface = surface_points(points);
  std::fill_n(points.optical_depth, points.padded_count, 0.0f);
  if (!has_casters(instance)) return 0;
  std::fill_n(points.open, points.padded_count, 1.0f);
  std::size_t count = 0;
  for (const std::uint32_t caster : instance.plan.casters) {
    const SphereSoa spheres = caster_spheres(scene, instance, scene.instances[caster]);
    scene.kernels->composed_depth(spheres, surface, points.optical_depth);
    count += spheres.count;
  }
  for_free_spheres(scene, instance, [&](const SphereSoa& spheres) {
    scene.kernels->exact_open(spheres, surface, points.open);
    count += spheres.count;
  });
  scene.kernels->composed_occlusion(points.optical_depth, points.open, points.padded_count,
                                    points.optical_depth);
  return count;
}

std::size_t join_paper_norm(const Scene& scene, const Instance& instance, const PointLanes& points) {
  std::size_t count = 0;
  const auto join = [&](const SphereSoa& spheres) {
    scene.kernels->self_norm_sum(spheres, fitted_points(points), instance.model->model.kernel,
                                 points.norm_sum);
    count += spheres.count;
  };
  for (const std::uint32_t caster : instance.plan.casters)
    join(spheres_of(scene.instances[caster], instance.plan.level));
  for_free_spheres(scene, instance, join);
  std::fill_n(points.optical_depth, points.padded_count, 0.0f);
  return count;
}

// Adds the body's own spheres to norm_sum, and returns the number of sphere-key-point pairs. If the instance
// has a light, evaluates each sphere instead of the tree. The reason is that directional occlusion evaluates
// each sphere too, and divides its coloured sums by this sum.
std::uint64_t sum_own_spheres(const Scene& scene, const Instance& instance, const PointLanes& points) {
  const SphereSoa spheres = spheres_of(instance, instance.plan.level);
  const SphereTree& tree = instance.model->sphere_tree;
  if (may_group(scene) && !tree.is_empty() && instance.plan.level == 0 && instance.light().count == 0) {
    PosedSphereTree posed;
    return scene.kernels->tree_sum(pose_tree(tree, spheres, scene.settings.far_error, posed),
                                   fitted_points(points), points.norm_sum);
  }
  scene.kernels->self_norm_sum(spheres, fitted_points(points), instance.model->model.kernel, points.norm_sum);
  return std::uint64_t{spheres.count} * points.count;
}

// Computes the values of all key points from the evaluated key points. The padding repeats the last key
// point. Scale and offset apply only to self-shadow.
void spread_level(const CharacterLevel& level, bool with_self, const PointLanes& points) {
  for (std::uint32_t k = 0; k < points.count; ++k) {
    const std::uint16_t source = level.source[k];
    points.shadow[k] = with_self ? std::max(level.scale[k] * points.norm_sum[source] + level.offset[k], 0.0f)
                                 : points.norm_sum[source];
    points.added[k] = points.optical_depth[source];
  }
  for (float* lane : {points.shadow, points.added})
    std::fill(lane + points.count, lane + points.padded_count, lane[points.count - 1]);
}

void encode_shadows(const Scene& scene, Instance& instance) {
  const LinearView& layer = instance.model->linear.view();
  PointLanes& p = instance.parts->arrays.points;
  scene.kernels->encode_points(p.shadow, p.padded_count, layer.shadow_limit, p.shadow_codes);
  if (instance.result.has_added)
    scene.kernels->encode_points(p.added, p.padded_count, layer.occlusion_limit, p.added_codes);
}

}  // namespace

void transform_spheres(const Scene& scene, Instance& instance) noexcept {
  const auto transform = [&](const RestSpheres& rest, const SphereLanes& s) {
    scene.kernels->pose_spheres(rest.view(), instance.bones().data(), {}, {s.x, s.y, s.z, s.inverse_radius});
  };
  InstanceResult& result = instance.result;
  const InstanceArrays& arrays = instance.arrays();
  const std::uint64_t revision = instance.input.pose_revision;
  if (result.transformed_revision != revision) transform(instance.model->rest_spheres, arrays.spheres);
  result.transformed_revision = revision;
  const bool needs_coarse = instance.plan.level > 0 || may_darken(scene, instance);
  if (!needs_coarse || result.coarse_revision == revision) return;
  for (std::size_t l = 0; l < instance.model->levels.size(); ++l)
    transform(instance.model->levels[l].rest_spheres, arrays.coarse_spheres[l]);
  result.coarse_revision = revision;
}

void group_spheres(const Scene& scene, Instance& instance) noexcept {
  if (!may_darken(scene, instance) || !may_group(scene)) return;
  if (instance.result.grouped_revision == instance.input.pose_revision) return;
  SphereSoa parts = spheres_of(instance, 0);
  const float* moments = nullptr;
  for (std::uint32_t t = 0; t < group_tiers; ++t) {
    const GroupLanes& groups = instance.arrays().groups[t];
    merge_groups(instance.model->groups.tier(t), parts, moments, groups);
    moments = groups.moment;
    parts = {groups.x, groups.y, groups.z, groups.inverse_radius, groups.caster_weight, groups.count};
  }
  instance.result.grouped_revision = instance.input.pose_revision;
}

void transform_key_points(const Scene& scene, Instance& instance) noexcept {
  const PointLanes& p = instance.arrays().points;
  const KeyPointTarget fitted{p.x, p.y, p.z, p.nx, p.ny, p.nz};
  const KeyPointTarget surface{p.surface_x,  p.surface_y,  p.surface_z,
                               p.surface_nx, p.surface_ny, p.surface_nz};
  const bool is_surface_felt = scene.settings.form == NOOK_FORM_DEFAULT && has_casters(instance);
  scene.kernels->pose_key_points(rest_points_of(instance).view(), instance.bones().data(), {}, fitted,
                                 is_surface_felt ? &surface : nullptr);
  if (may_group(scene) && !instance.plan.casters.empty()) {
    const PointLanes points = evaluated_points(instance);
    instance.parts->receiver = receiver_of(points.surface_x, points.surface_y, points.surface_z, points.count,
                                           instance.input.largest_scale());
  }
}

void evaluate_shadows(const Scene& scene, Instance& instance) noexcept {
  const PointLanes points = evaluated_points(instance);
  const Kernel& kernel = instance.model->model.kernel;
  std::fill_n(points.norm_sum, points.padded_count, 0.0f);
  const std::uint64_t own = has_self_shadow(scene, instance) ? sum_own_spheres(scene, instance, points) : 0;
  const bool composed = scene.settings.form == NOOK_FORM_DEFAULT;
  const std::size_t added =
      composed ? evaluate_composed(scene, instance, points) : join_paper_norm(scene, instance, points);
  instance.result.evaluations = own + std::uint64_t{added} * points.count;
  instance.result.has_added = composed && added > 0;
  const float* saturation = rest_points_of(instance).view().saturation;
  if (instance.plan.level == 0) {
    scene.kernels->norm_root(points.norm_sum, saturation, points.padded_count, kernel.gamma, points.shadow);
    std::copy_n(points.optical_depth, points.padded_count, points.added);
  } else {
    scene.kernels->norm_root(points.norm_sum, saturation, points.padded_count, kernel.gamma, points.norm_sum);
    spread_level(instance.model->model.levels[instance.plan.level - 1], has_self_shadow(scene, instance),
                 instance.arrays().points);
  }
  encode_shadows(scene, instance);
  instance.result.evaluated_frame = scene.frame;
}

void update(Scene& scene) noexcept {
  ++scene.frame;
  scene.was_updated_on_cpu = true;
  resolve_casters(scene,
                  [&](std::uint32_t slot) { return scene.instances[slot].result.evaluated_frame > 0; });
  const auto slots = static_cast<std::uint32_t>(scene.instances.size());
  auto transform = [&](std::uint32_t slot) noexcept {
    Instance& instance = scene.instances[slot];
    if (instance.id == 0) return;
    decode_late_bones(instance);
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

// The source of the AO that an instance has without casters.
enum class Self { none, shadow, clip };

Self self_of(const Scene& scene, const Instance& instance) {
  if (!(scene.terms & NOOK_TERM_SELF)) return Self::none;
  return instance.input.clip.is_used() ? Self::clip : Self::shadow;
}

constexpr std::uint32_t chunk_slots = LoadedModel::slot_chunk,
                        chunk_blocks = chunk_slots / linear_block_vertices;
static_assert(LoadedClips::block_slots == chunk_slots);
using ChunkAo = std::array<float, chunk_slots>;

// For each chunk of the model's linear layer, calls evaluate(layer, first_slot), then put(place, slot) for
// each file vertex of the chunk. `place` is the vertex's output address: vertices are stride_bytes apart.
// `slot` is relative to the chunk.
template <class Stride, class Evaluate, class Put>
void for_each_chunk(const LoadedModel& loaded, const float* open_bias, void* out, Stride stride_bytes,
                    Evaluate&& evaluate, Put&& put) noexcept {
  const LinearView& view = loaded.linear.view();
  auto* const bytes = static_cast<unsigned char*>(out);
  // Copies the pointers into local variables. Otherwise the compiler must reload them after each write,
  // because the written bytes could alias them.
  const std::uint32_t* const begin = loaded.run_begin.data();
  const LoadedModel::FileRun* const runs = loaded.file_run.data();
  const std::uint16_t* const slots = loaded.slot_in_chunk.data();
  for (std::uint32_t block = 0; block < view.block_count; block += chunk_blocks) {
    const std::uint32_t first_slot = block * linear_block_vertices;
    LinearView chunk = view;
    chunk.blocks += block;
    chunk.block_count = std::min(chunk_blocks, view.block_count - block);
    chunk.open_bias = open_bias + first_slot;
    evaluate(chunk, first_slot);
    const std::uint32_t number = first_slot / chunk_slots, last = begin[number + 1];
    for (std::uint32_t r = begin[number]; r < last; ++r) {
      const LoadedModel::FileRun run = runs[r];
      unsigned char* place = bytes + run.first_vertex * stride_bytes;
      const std::uint16_t* const slot = slots + run.first_entry;
      for (std::uint32_t i = 0; i < run.vertices; ++i, place += stride_bytes) put(place, slot[i]);
    }
  }
}

// The weights of the AO modes for the current frame of an instance's clip.
using ClipWeights = std::array<float, ClipSet::max_ao_modes>;

void mix_weights(const Instance& instance, Self self, ClipWeights& weights) {
  const InstanceClip& clip = instance.input.clip;
  if (self == Self::clip) mix_ao_weights(clip.clips->set, clip.mix, weights.data());
}

// Writes the clip's AO for the slots of the chunk to `own`.
void decode_clip(const Instance& instance, const ClipWeights& weights, const LinearView& chunk,
                 std::uint32_t first_slot, ChunkAo& own) {
  decode_ao(*instance.input.clip.clips, weights.data(), first_slot, chunk.block_count * linear_block_vertices,
            own.data());
}

const float* open_bias_of(const LoadedModel& loaded, Self self) {
  return self == Self::shadow ? loaded.linear.view().open_bias : loaded.open_without_bias.data();
}

// Calls put(place, number) for each file vertex. `place` is the vertex's output address: vertices are
// stride_bytes apart. `convert` converts the AO of a whole chunk to the type Number.
template <class Number, class Stride, class Convert, class Put>
void for_each_ao(const Scene& scene, const Instance& instance, void* out, Stride stride_bytes,
                 Convert&& convert, Put&& put) noexcept {
  const LoadedModel& loaded = *instance.model;
  auto* const bytes = static_cast<unsigned char*>(out);
  if (instance.result.evaluated_frame == 0) {
    for (std::size_t i = 0; i < loaded.model.file_to_welded.size(); ++i)
      put(bytes + i * stride_bytes, convert(1.0f));
    return;
  }
  const Self self = self_of(scene, instance);
  const PointLanes& points = instance.arrays().points;
  const PointCodes* const added = instance.result.has_added ? &points.added_codes : nullptr;
  ClipWeights weights;
  mix_weights(instance, self, weights);
  alignas(64) ChunkAo ao, own;
  alignas(64) std::array<Number, chunk_slots> numbers;
  for_each_chunk(
      loaded, open_bias_of(loaded, self), out, stride_bytes,
      [&](const LinearView& chunk, std::uint32_t first_slot) {
        scene.kernels->linear_layer(chunk, points.shadow_codes, added, ao.data());
        const std::uint32_t count = chunk.block_count * linear_block_vertices;
        if (self == Self::clip) {
          decode_clip(instance, weights, chunk, first_slot, own);
          for (std::uint32_t i = 0; i < count; ++i) ao[i] *= own[i];
        }
        for (std::uint32_t i = 0; i < count; ++i) numbers[i] = convert(ao[i]);
      },
      [&](unsigned char* place, std::uint32_t slot) { put(place, numbers[slot]); });
}

// A stride that is a compile-time constant saves a multiplication for each vertex.
template <class Number, class Convert>
void write_ao(const Scene& scene, const Instance& instance, void* out, std::size_t stride_bytes,
              Convert&& convert) noexcept {
  const auto put = [](unsigned char* place, Number number) { std::memcpy(place, &number, sizeof number); };
  if (stride_bytes == sizeof(Number))
    for_each_ao<Number>(scene, instance, out, std::integral_constant<std::size_t, sizeof(Number)>(), convert,
                        put);
  else
    for_each_ao<Number>(scene, instance, out, stride_bytes, convert, put);
}

constexpr auto same = [](float ao) { return ao; };

}  // namespace

void read_ao(const Scene& scene, const Instance& instance, float* out, std::size_t stride_bytes) noexcept {
  write_ao<float>(scene, instance, out, stride_bytes, same);
}

void read_ao_as(const Scene& scene, const Instance& instance, nook_format format, void* out,
                std::size_t stride_bytes) noexcept {
  switch (format) {
    case NOOK_FORMAT_HALF:
      return write_ao<std::uint16_t>(scene, instance, out, stride_bytes,
                                     [](float ao) { return to_half(ao); });
    case NOOK_FORMAT_UNORM8:
      return write_ao<std::uint8_t>(scene, instance, out, stride_bytes,
                                    [](float ao) { return static_cast<std::uint8_t>(ao * 255 + 0.5f); });
    default:
      return write_ao<float>(scene, instance, out, stride_bytes, same);
  }
}

void read_directional_ao(const Scene& scene, const Instance& instance, float* out,
                         std::size_t stride_bytes) noexcept {
  const auto put_three = [](unsigned char* place, float r, float g, float b) {
    const float rgb[] = {r, g, b};
    std::memcpy(place, rgb, sizeof rgb);
  };
  const InstanceLight& light = instance.light();
  if (!light.evaluated)
    return for_each_ao<float>(scene, instance, out, stride_bytes, same,
                              [&](unsigned char* place, float ao) { put_three(place, ao, ao, ao); });
  const LoadedModel& loaded = *instance.model;
  const bool composed = scene.settings.form == NOOK_FORM_DEFAULT;
  const Self self = self_of(scene, instance);
  alignas(64) std::array<ChunkAo, 3> ao;
  ClipWeights weights;
  mix_weights(instance, self, weights);
  alignas(64) ChunkAo own;
  float* const rgb[] = {ao[0].data(), ao[1].data(), ao[2].data()};
  for_each_chunk(
      loaded, open_bias_of(loaded, self), out, stride_bytes,
      [&](const LinearView& chunk, std::uint32_t first_slot) {
        scene.kernels->directional_linear_layer(chunk, instance.arrays().points.shadow, light.shadow,
                                                composed ? light.added : nullptr, rgb);
        if (self != Self::clip) return;
        decode_clip(instance, weights, chunk, first_slot, own);
        for (ChunkAo& channel : ao)
          for (std::uint32_t i = 0; i < chunk.block_count * linear_block_vertices; ++i) channel[i] *= own[i];
      },
      [&](unsigned char* place, std::uint32_t slot) {
        put_three(place, ao[0][slot], ao[1][slot], ao[2][slot]);
      });
}

}  // namespace nook
