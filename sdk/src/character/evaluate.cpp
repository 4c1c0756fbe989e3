// The steps of an update on the CPU, each a few calls of the kernels in use.
#include <algorithm>
#include <array>
#include <cstring>

#include "character/scene.h"

namespace nook {
namespace {

SphereSoa spheres_of(const Instance& instance) {
  const SphereLanes& s = instance.arrays.spheres;
  return {s.x, s.y, s.z, s.inverse_radius, instance.model->rest_spheres.caster_weight(), s.count};
}

KeyPointSoa fitted_points(const PointLanes& p) {
  return {p.x, p.y, p.z, p.nx, p.ny, p.nz, p.padded_count};
}
KeyPointSoa surface_points(const PointLanes& p) {
  return {p.surface_x, p.surface_y, p.surface_z, p.surface_nx, p.surface_ny, p.surface_nz, p.padded_count};
}

// Ground and free occluders in batches on the stack; their caster weight is 1.
template <class Apply>
void for_free_spheres(const Scene& scene, const Instance& instance, Apply&& apply) {
  constexpr std::uint32_t batch = 16;
  std::array<float, batch> x{}, y{}, z{}, inverse_radius{};
  std::uint32_t count = 0;
  const auto flush = [&] {
    if (count > 0) apply(SphereSoa{x.data(), y.data(), z.data(), inverse_radius.data(), nullptr, count});
    count = 0;
  };
  const auto push = [&](const Sphere& sphere) {
    x[count] = sphere.centre.x;
    y[count] = sphere.centre.y;
    z[count] = sphere.centre.z;
    inverse_radius[count] = inverse_sphere_radius(sphere.radius);
    if (++count == batch) flush();
  };
  if (instance.ground_sphere.radius > 0) push(instance.ground_sphere);
  for (const std::uint32_t slot : instance.occluders) push(scene.occluders[slot].sphere);
  flush();
}

void evaluate_composed(const Scene& scene, Instance& instance) {
  const PointLanes& points = instance.arrays.points;
  const KeyPointSoa surface = surface_points(points);
  std::fill_n(points.optical_depth, points.padded_count, 0.0f);
  std::fill_n(points.open, points.padded_count, 1.0f);
  for (const std::uint32_t caster : instance.casters)
    scene.kernels->composed_depth(spheres_of(scene.instances[caster]), surface, points.optical_depth);
  for_free_spheres(scene, instance, [&](const SphereSoa& spheres) {
    scene.kernels->exact_open(spheres, surface, points.open);
  });
  scene.kernels->composed_occlusion(points.optical_depth, points.open, points.padded_count, points.added);
}

void join_paper_norm(const Scene& scene, Instance& instance) {
  const PointLanes& points = instance.arrays.points;
  const Kernel& kernel = instance.model->model.kernel;
  for (const std::uint32_t caster : instance.casters)
    scene.kernels->self_norm_sum(spheres_of(scene.instances[caster]), fitted_points(points), kernel,
                                 points.norm_sum);
  for_free_spheres(scene, instance, [&](const SphereSoa& spheres) {
    scene.kernels->self_norm_sum(spheres, fitted_points(points), kernel, points.norm_sum);
  });
  std::fill_n(points.added, points.padded_count, 0.0f);
}

std::uint64_t count_evaluations(const Scene& scene, const Instance& instance) {
  std::uint64_t spheres = (scene.terms & NOOK_TERM_SELF ? instance.arrays.spheres.count : 0) +
                          instance.occluders.size() + (instance.ground_sphere.radius > 0);
  for (const std::uint32_t caster : instance.casters) spheres += scene.instances[caster].arrays.spheres.count;
  return spheres * instance.arrays.points.count;
}

}  // namespace

void transform_spheres(const Scene& scene, Instance& instance) noexcept {
  if (instance.transformed_revision == instance.pose_revision) return;
  const SphereLanes& s = instance.arrays.spheres;
  scene.kernels->pose_spheres(instance.model->rest_spheres.view(), instance.bones.data(), {},
                              {s.x, s.y, s.z, s.inverse_radius});
  instance.transformed_revision = instance.pose_revision;
}

void transform_key_points(const Scene& scene, Instance& instance) noexcept {
  const PointLanes& p = instance.arrays.points;
  const KeyPointTarget fitted{p.x, p.y, p.z, p.nx, p.ny, p.nz};
  const KeyPointTarget surface{p.surface_x,  p.surface_y,  p.surface_z,
                               p.surface_nx, p.surface_ny, p.surface_nz};
  const bool composed = scene.settings.combine == NOOK_COMBINE_COMPOSED;
  scene.kernels->pose_key_points(instance.model->rest_key_points.view(), instance.bones.data(), {}, fitted,
                                 composed ? &surface : nullptr);
}

void evaluate_shadows(const Scene& scene, Instance& instance) noexcept {
  const PointLanes& points = instance.arrays.points;
  const Kernel& kernel = instance.model->model.kernel;
  std::fill_n(points.norm_sum, points.padded_count, 0.0f);
  if (scene.terms & NOOK_TERM_SELF)
    scene.kernels->self_norm_sum(spheres_of(instance), fitted_points(points), kernel, points.norm_sum);
  if (scene.settings.combine == NOOK_COMBINE_COMPOSED)
    evaluate_composed(scene, instance);
  else
    join_paper_norm(scene, instance);
  scene.kernels->norm_root(points.norm_sum, points.padded_count, kernel.gamma, points.shadow);
  instance.evaluations = count_evaluations(scene, instance);
  instance.evaluated_frame = scene.frame;
}

void update(Scene& scene) noexcept {
  ++scene.frame;
  resolve_casters(scene);
  const auto slots = static_cast<std::uint32_t>(scene.instances.size());
  auto transform = [&](std::uint32_t slot) noexcept {
    Instance& instance = scene.instances[slot];
    if (instance.id == 0) return;
    transform_spheres(scene, instance);
    if (instance.due) transform_key_points(scene, instance);
  };
  parallel_for(scene.parallel, slots, transform);
  auto evaluate = [&](std::uint32_t slot) noexcept {
    Instance& instance = scene.instances[slot];
    if (instance.id && instance.due) evaluate_shadows(scene, instance);
  };
  parallel_for(scene.parallel, slots, evaluate);

  scene.stats = {};
  scene.stats.instances = scene.living;
  for (const Instance& instance : scene.instances) {
    if (instance.id == 0 || !instance.due) continue;
    ++scene.stats.instances_updated;
    scene.stats.links += static_cast<std::uint32_t>(instance.casters.size());
    scene.stats.links_culled += instance.culled;
    scene.stats.evaluations += instance.evaluations;
  }
}

void read_ao(const Scene& scene, const Instance& instance, float* out, std::size_t stride_bytes) noexcept {
  const LoadedModel& loaded = *instance.model;
  const PointLanes& points = instance.arrays.points;
  LinearView view = loaded.linear.view();
  if (!(scene.terms & NOOK_TERM_SELF)) view.open_bias = loaded.open_without_bias.data();
  const float* added = scene.settings.combine == NOOK_COMBINE_COMPOSED ? points.added : nullptr;

  constexpr std::uint32_t chunk_blocks = 16;
  alignas(64) std::array<float, chunk_blocks * linear_block_vertices> ao;
  auto* const bytes = reinterpret_cast<unsigned char*>(out);
  if (instance.evaluated_frame == 0) {
    const float open = 1;
    for (std::size_t i = 0; i < loaded.model.file_to_welded.size(); ++i)
      std::memcpy(bytes + i * stride_bytes, &open, sizeof open);
    return;
  }
  for (std::uint32_t block = 0; block < view.block_count; block += chunk_blocks) {
    const std::uint32_t first_slot = block * linear_block_vertices;
    const LinearView chunk{view.blocks + block,
                           std::min(chunk_blocks, view.block_count - block),
                           view.key_point,
                           view.alpha,
                           view.open_bias + first_slot,
                           view.inverse_alpha_sum + first_slot};
    scene.kernels->linear_layer(chunk, points.shadow, added, ao.data());
    const std::uint32_t end = first_slot + chunk.block_count * linear_block_vertices;
    for (std::uint32_t slot = first_slot; slot < end; ++slot)
      for (std::uint32_t i = loaded.slot_begin[slot]; i < loaded.slot_begin[slot + 1]; ++i)
        std::memcpy(bytes + loaded.slot_file_vertex[i] * stride_bytes, &ao[slot - first_slot], sizeof(float));
  }
}

}  // namespace nook
