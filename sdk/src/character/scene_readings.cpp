#include "sdk/src/character/scene_readings.h"

#include <algorithm>
#include <cstddef>

#include "sdk/src/character/instance_light.h"
#include "sdk/src/character/scene.h"

namespace nook {

std::uint64_t instance_bytes(const LoadedModel& model) {
  std::uint64_t words = sphere_lanes * padded_count(model.model.spheres.size()) +
                        (point_lanes + code_lanes) * model.rest_key_points.padded_count();
  for (const LoadedLevel& level : model.levels)
    words += sphere_lanes * padded_count(level.rest_spheres.view().count);
  for (std::uint32_t t = 0; t < group_tiers; ++t)
    words += group_lanes * padded_count(model.groups.tier(t).count());
  return sizeof(Instance) + sizeof(InstanceParts) + words * sizeof(float) +
         model.model.bone_count() * sizeof(Mat3x4) + model.model.world_casters.size() * sizeof(PosedCaster) +
         (model.model.bone_count() + 7) / 8;
}

std::uint64_t light_bytes(const LoadedModel& model) {
  return light_lanes * model.rest_key_points.padded_count() * sizeof(float) +
         max_light_lobes * (sizeof(LightLobe) + sizeof(LobeBands));
}

std::uint32_t uneven_instances(const Scene& scene) noexcept {
  std::uint32_t count = 0;
  for (const Instance& instance : scene.instances) {
    const UnevenBones& uneven = instance.uneven();
    count += instance.id && std::find(uneven.begin(), uneven.end(), true) != uneven.end();
  }
  return count;
}

namespace {

// Returns null at full detail.
const CharacterLevel* level_of(const Instance& instance) {
  const auto& levels = instance.model->model.levels;
  return instance.plan.level == 0 ? nullptr : &levels[instance.plan.level - 1];
}

const Vector<ProxySphere>& spheres_of(const Instance& instance) {
  const CharacterLevel* const level = level_of(instance);
  return level ? level->spheres : instance.model->model.spheres;
}

void write(float (&out)[3], Vec3 v) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

// Returns the weighted mean of the bones' matrices, as in linear blend skinning.
Mat3x4 blended(const Vector<Mat3x4>& bones, const KeyPoint& point) {
  Mat3x4 blend{{}};
  for (std::size_t b = 0; b < KeyPoint::max_bones; ++b)
    for (std::size_t j = 0; j < std::size(blend.m); ++j)
      blend.m[j] += point.weight[b] * bones[point.bone[b]].m[j];
  return blend;
}

// Returns false if the instance in the caster's slot was removed, or was added after the lists of the plan
// were made.
bool is_there(const Instance& caster, const InstancePlan& plan) {
  return caster.id != 0 && caster.added_frame < plan.frame;
}

nook_scene_key_point posed(const Instance& instance, std::uint32_t index) {
  const KeyPoint& point = instance.model->model.key_points[index];
  const Mat3x4 blend = blended(instance.bones(), point);
  const bool has_values = instance.result.evaluated_frame > 0;
  nook_scene_key_point out{};
  write(out.position_ws, transform_point(blend, point.position));
  write(out.normal_ws, normalised(transform_vector(blend, point.normal)));
  write(out.surface_position_ws, transform_point(blend, point.surface_position));
  out.shadow = has_values ? instance.arrays().points.shadow[index] : -1;
  out.added = has_values ? instance.arrays().points.added[index] : -1;
  out.index = index;
  return out;
}

}  // namespace

std::uint32_t sphere_count(const Instance& instance) noexcept {
  return static_cast<std::uint32_t>(spheres_of(instance).size());
}

std::uint32_t key_point_count(const Instance& instance) noexcept {
  const CharacterLevel* const level = level_of(instance);
  return static_cast<std::uint32_t>(level ? level->evaluated.size()
                                          : instance.model->model.key_points.size());
}

std::uint32_t link_count(const Scene& scene, const Instance& instance) noexcept {
  std::uint32_t count = 0;
  for (const std::uint32_t slot : instance.plan.casters)
    count += is_there(scene.instances[slot], instance.plan);
  return count;
}

nook_scene_instance_info describe_instance(const Scene& scene, const Instance& instance) noexcept {
  const CharacterLevel* const level = level_of(instance);
  nook_scene_instance_info info{};
  info.struct_size = sizeof info;
  info.level = instance.plan.level;
  info.level_error = level ? level->error_rms : 0;
  info.sphere_count = sphere_count(instance);
  info.key_point_count = key_point_count(instance);
  info.link_count = link_count(scene, instance);
  info.culled_count = instance.plan.culled;
  info.updated = scene.frame > 0 && instance.plan.frame == scene.frame;
  write(info.bound_centre_ws, instance.input.bound.centre);
  info.bound_radius = instance.input.bound.radius;
  return info;
}

void read_spheres(const Instance& instance, nook_scene_sphere* out) noexcept {
  for (const ProxySphere& sphere : spheres_of(instance)) {
    const Mat3x4& bone = instance.bones()[sphere.bone];
    // Bones are rigid or have a uniform scale, so the length of each row of the linear part is the scale.
    const float scale = length({bone.m[0], bone.m[1], bone.m[2]});
    nook_scene_sphere& posed_sphere = *out++;
    write(posed_sphere.centre_ws, transform_point(bone, sphere.centre));
    posed_sphere.radius = scale * sphere.radius;
    posed_sphere.bone = sphere.bone;
    posed_sphere.caster_weight = sphere.caster_weight;
  }
}

void read_key_points(const Instance& instance, nook_scene_key_point* out) noexcept {
  const CharacterLevel* const level = level_of(instance);
  const std::uint32_t count = key_point_count(instance);
  for (std::uint32_t i = 0; i < count; ++i) out[i] = posed(instance, level ? level->evaluated[i] : i);
}

void read_links(const Scene& scene, const Instance& instance, nook_instance_id* out) noexcept {
  for (const std::uint32_t slot : instance.plan.casters)
    if (is_there(scene.instances[slot], instance.plan)) *out++ = scene.instances[slot].id;
}

}  // namespace nook
