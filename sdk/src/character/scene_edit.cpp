#include <algorithm>
#include <bit>
#include <cmath>

#include "sdk/src/character/bone_axes.h"
#include "sdk/src/character/gpu_pose.h"
#include "sdk/src/character/pose_bound.h"
#include "sdk/src/character/scene.h"
#include "sdk/src/character/scene_clips.h"
#include "sdk/src/character/scene_pool.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"

namespace nook {
namespace {

constexpr std::uint32_t slot_in(std::uint32_t id) {
  return (id & max_slots) - 1;
}

// Returns the slot for the next object: a free slot, or one past the end. Also reserves memory in the free
// list, so that the slot can be freed later without an allocation.
template <class Object>
std::uint32_t next_slot(const Vector<Object>& objects, Vector<std::uint32_t>& free_slots, const char* what) {
  if (!free_slots.empty()) return free_slots.back();
  if (objects.size() >= max_slots)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the scene is full of %s (got %zu, need less than %u); use a second scene", what,
                  objects.size(), max_slots);
  free_slots.reserve(std::bit_ceil(objects.size() + 1));
  return static_cast<std::uint32_t>(objects.size());
}

template <class Objects>
auto& find(Objects& objects, std::uint32_t id, const char* what) {
  const std::uint32_t slot = slot_in(id);
  if (id == 0 || slot >= objects.size() || objects[slot].id != id)
    throw Failure(NOOK_ERROR_INVALID_HANDLE,
                  "this scene has no %s %u; it was removed, or belongs to another scene", what, id);
  return objects[slot];
}

// Returns the nearest matrix with a uniform scale.
Mat3x4 evened(const CharacterModel& model, const Mat3x4& matrix, std::size_t bone) {
  return to_float(projected(to_double(matrix), joint_origin(model, bone)));
}

void derive_bound(Instance& instance, float largest_scale_squared) {
  const PoseBound bound = bound_of_bones(*instance.model, {instance.bones().data(), instance.bones().size()},
                                         largest_scale_squared);
  instance.input.bound = {bound.centre, bound.radius};
  instance.input.scale = bound.scale;
}

std::uint32_t slot_of(const Scene& scene, const Instance& instance) {
  return static_cast<std::uint32_t>(&instance - scene.instances.data());
}

using Slots = Vector<std::uint32_t>;

void make_room_for_one(Slots& slots) {
  if (slots.size() == slots.capacity()) slots.reserve(std::bit_ceil(slots.size() + 1));
}

// insert_slot and the function below expect slots in ascending order.
void insert_slot(Slots& slots, std::uint32_t slot) {
  slots.insert(std::lower_bound(slots.begin(), slots.end(), slot), slot);
}
bool erase_slot(Slots& slots, std::uint32_t slot) {
  const auto at = std::lower_bound(slots.begin(), slots.end(), slot);
  if (at == slots.end() || *at != slot) return false;
  slots.erase(at);
  return true;
}

}  // namespace

InstanceArrays make_instance_arrays(const LoadedModel& model, Memory* memory) {
  InstanceArrays arrays;
  PointLanes& points = arrays.points;
  points.count = static_cast<std::uint32_t>(model.model.key_points.size());
  points.padded_count = model.rest_key_points.padded_count();
  arrays.spheres.count = static_cast<std::uint32_t>(model.model.spheres.size());
  std::size_t size = sphere_lanes * padded_count(arrays.spheres.count) + point_lanes * points.padded_count;
  for (std::size_t l = 0; l < model.levels.size(); ++l) {
    arrays.coarse_spheres[l].count = model.levels[l].rest_spheres.view().count;
    size += sphere_lanes * padded_count(arrays.coarse_spheres[l].count);
  }

  for (std::uint32_t t = 0; t < group_tiers; ++t) {
    arrays.groups[t].count = model.groups.tier(t).count();
    size += group_lanes * padded_count(arrays.groups[t].count);
  }

  arrays.storage = AlignedArray<float>(size, memory);
  float* at = arrays.storage.data();
  const auto take = [&](auto& lanes, const auto& members, std::size_t count) {
    for (const auto lane : members) {
      lanes.*lane = at;
      at += count;
    }
  };
  take(arrays.spheres, sphere_members, padded_count(arrays.spheres.count));
  for (std::size_t l = 0; l < model.levels.size(); ++l)
    take(arrays.coarse_spheres[l], sphere_members, padded_count(arrays.coarse_spheres[l].count));
  for (GroupLanes& groups : arrays.groups) take(groups, group_members, padded_count(groups.count));
  take(points, point_members, points.padded_count);
  arrays.codes = AlignedArray<std::int32_t>(code_lanes * points.padded_count, memory);
  std::int32_t* code = arrays.codes.data();
  for (const auto codes : point_code_members)
    for (const auto lane : code_members) {
      points.*codes.*lane = code;
      code += points.padded_count;
    }
  return arrays;
}

Scene::Scene(const SceneSettings& scene_settings, const Parallel& host_parallel, Memory* scene_memory)
    : settings(scene_settings),
      kernels(shadow_kernels(choose_isa(settings.isa))),
      parallel(host_parallel),
      memory(scene_memory),
      instances(memory),
      free_instances(memory),
      occluders(memory),
      free_occluders(memory),
      neighbours(memory),
      converted(memory),
      converted_uneven(memory),
      pool(memory) {}

Instance& instance_of(Scene& scene, nook_instance_id id) {
  return find(scene.instances, id, "instance");
}
const Instance& instance_of(const Scene& scene, nook_instance_id id) {
  return find(scene.instances, id, "instance");
}

nook_instance_id add_instance(Scene& scene, Ref<const LoadedModel> model) {
  const std::uint32_t slot = next_slot(scene.instances, scene.free_instances, "instances");
  const bool fresh = slot == scene.instances.size();
  Instance added(scene.memory);
  added.generation = fresh ? 0 : scene.instances[slot].generation;
  added.id = added.generation << id_slot_bits | (slot + 1);
  const std::size_t bones = model->model.bone_count();
  if (scene.converted.size() < bones) {
    scene.converted.resize(bones);
    scene.converted_uneven.resize(bones);
  }
  added.plan.casters.reserve(scene.nearest);
  added.plan.occluders.reserve(scene.occluders.size());
  added.model = std::move(model);
  need_own_parts(scene, added);
  if (scene.has_arrays) added.parts->arrays = make_instance_arrays(*added.model, scene.memory);
  added.input.pose_revision = 1;
  added.added_frame = scene.frame;
  derive_bound(added, 1);
  if (scene.pool.is_used()) {
    added.parts = {};
    added.plan.is_far = true;
  }
  const std::size_t slots = scene.instances.size() + (fresh ? 1 : 0);
  if (scene.nearest) reserve_tree(scene.neighbours, std::bit_ceil(slots));
  if (fresh) {
    scene.instances.push_back(std::move(added));
  } else {
    scene.free_instances.pop_back();
    scene.instances[slot] = std::move(added);
  }
  ++scene.living;
  ++scene.structure_revision;
  return scene.instances[slot].id;
}

void remove_instance(Scene& scene, nook_instance_id id) {
  Instance& removed = instance_of(scene, id);
  const std::uint32_t slot = slot_of(scene, removed);
  const std::uint32_t generation = removed.generation + 1;
  for (const std::uint32_t receiver : removed.input.receivers)
    erase_slot(scene.instances[receiver].input.linked, slot);
  for (const std::uint32_t caster : removed.input.linked)
    erase_slot(scene.instances[caster].input.receivers, slot);
  leave_gpu_pose(scene, removed);
  return_parts(scene, removed);
  removed = Instance(scene.memory);
  removed.generation = generation;
  if (generation < id_generations) scene.free_instances.push_back(slot);
  --scene.living;
  ++scene.structure_revision;
}

namespace {

// Updates everything that depends on the bone matrices. All new matrices must have a uniform scale and no
// shear.
void finish_pose(Instance& instance, float longest_squared) {
  derive_bound(instance, longest_squared);
  ++instance.input.pose_revision;
}

PoseNotes take_pose(Instance& instance, std::span<const Mat3x4> bones) {
  const CharacterModel& model = instance.model->model;
  PoseNotes notes;
  notes.bones = static_cast<std::uint32_t>(bones.size());
  float longest_squared = 0;
  InstanceParts& parts = *instance.parts;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    BoneAxes<float> axes = axes_of(bones[b]);
    const bool is_uneven = !axes.is_even();
    parts.bones[b] = bones[b];
    parts.uneven[b] = is_uneven;
    if (is_uneven) {
      note_uneven(notes, b, axes_of(to_double(bones[b])));
      parts.bones[b] = evened(model, bones[b], b);
      axes = axes_of(parts.bones[b]);
    }
    longest_squared = std::max(longest_squared, axes.longest_squared);
  }
  finish_pose(instance, longest_squared);
  return notes;
}

// True if the transforms are rest-to-world matrices in this library's own layout. Such transforms are copied,
// because a product with the identity would turn -0 into 0.
bool holds_bone_matrices(const PoseSource& source) {
  return source.kind == NOOK_POSE_REST_TO_WORLD && source.layout == NOOK_TRANSFORM_ROWS_3X4 &&
         source.stride == sizeof(Mat3x4) && source.transform_of_bone.empty() && source.place.m == Affine{}.m;
}

// `bones` has one entry for each bone of the model.
PoseNotes set_bones(Instance& instance, std::span<const Mat3x4> bones, bool is_strict) {
  const CharacterModel& model = instance.model->model;
  for (std::size_t b = 0; b < bones.size(); ++b) {
    check_size(model, b, bones[b]);
    if (is_strict && !axes_of(bones[b]).is_even()) fail_uneven(model, b, axes_of(to_double(bones[b])));
  }
  leave_clip(instance);
  return take_pose(instance, bones);
}

}  // namespace

void make_arrays(Scene& scene) {
  if (scene.has_arrays) return;
  try {
    for (Instance& instance : scene.instances) {
      if (instance.id == 0) continue;
      instance.parts->arrays = make_instance_arrays(*instance.model, scene.memory);
      make_light_arrays(scene, instance);
    }
  } catch (...) {
    leave_arrays(scene);
    throw;
  }
  scene.has_arrays = true;
}

void leave_arrays(Scene& scene) noexcept {
  if (scene.was_updated_on_cpu) return;
  for (Instance& instance : scene.instances) {
    if (!instance.parts) continue;
    instance.parts->arrays = {};
    leave_light_arrays(instance);
  }
  scene.has_arrays = false;
}

void set_model(Scene& scene, nook_instance_id id, Ref<const LoadedModel> model) {
  Instance& instance = instance_of(scene, id);
  const std::size_t bones = instance.model->model.bone_count();
  if (model->model.bone_count() != bones)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the new model and the instance have different numbers of bones (got %zu, need %zu); "
                  "remove the instance and add it with the new model",
                  model->model.bone_count(), bones);
  need_cpu_pose(instance);
  decode_late_bones(instance);
  InstanceArrays arrays;
  if (scene.has_arrays) arrays = make_instance_arrays(*model, scene.memory);
  InstanceLight light = moved_light(scene, instance.light(), *model);
  InstanceCasters casters(scene.memory);
  casters.posed.resize(model->model.world_casters.size());
  instance.parts->arrays = std::move(arrays);
  instance.parts->light = std::move(light);
  // The clips belong to the old model. The instance keeps its pose until the host sets another one.
  leave_clip(instance);
  instance.parts->casters = std::move(casters);
  instance.model = std::move(model);
  float longest_squared = 0;
  for (const Mat3x4& bone : instance.bones())
    longest_squared = std::max(longest_squared, axes_of(bone).longest_squared);
  derive_bound(instance, longest_squared);
  ++instance.input.pose_revision;
  instance.result.evaluated_frame = 0;
  instance.plan.level = 0;
  ++scene.structure_revision;
}

PoseNotes set_pose(Scene& scene, nook_instance_id id, std::span<const Mat3x4> bones) {
  Instance& instance = instance_of(scene, id);
  const std::size_t wanted = instance.model->model.bone_count();
  if (bones.size() != wanted)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "bone_count differs from the model's bone count (got %zu, need %zu); see nook_model_describe",
        bones.size(), wanted);
  need_own_parts(scene, instance);
  const PoseNotes notes = set_bones(instance, bones, scene.settings.strict_poses);
  leave_gpu_pose(scene, instance);
  return notes;
}

PoseNotes set_pose(Scene& scene, nook_instance_id id, PoseSource source) {
  Instance& instance = instance_of(scene, id);
  const CharacterModel& model = instance.model->model;
  source.is_strict = source.is_strict || scene.settings.strict_poses;
  check_pose_source(model, source);
  // Bones that a partial pose does not set keep their matrices. If the current pose is on the GPU, the
  // matrices on the CPU are from an older pose, so a partial pose is refused.
  if (source.is_partial) {
    need_cpu_pose(instance);
    decode_late_bones(instance);
  }
  need_own_parts(scene, instance);
  static_assert(sizeof(Mat3x4) == 12 * sizeof(float) && alignof(Mat3x4) == alignof(float));
  if (holds_bone_matrices(source)) {
    PoseNotes notes =
        set_bones(instance, {reinterpret_cast<const Mat3x4*>(source.transforms), source.transform_count},
                  source.is_strict);
    notes.transforms_given = source.given_count;
    notes.transforms_used = source.transform_count;
    leave_gpu_pose(scene, instance);
    return notes;
  }
  InstanceParts& parts = *instance.parts;
  const std::span<Mat3x4> converted(scene.converted.data(), parts.bones.size());
  std::copy(parts.bones.begin(), parts.bones.end(), converted.begin());
  std::copy(parts.uneven.begin(), parts.uneven.end(), scene.converted_uneven.begin());
  const PoseNotes notes = convert_pose(model, source, converted, &scene.converted_uneven);
  leave_clip(instance);
  std::copy_n(scene.converted_uneven.begin(), converted.size(), parts.uneven.begin());
  float longest_squared = 0;
  for (std::size_t b = 0; b < converted.size(); ++b) {
    parts.bones[b] = converted[b];
    longest_squared = std::max(longest_squared, axes_of(converted[b]).longest_squared);
  }
  finish_pose(instance, longest_squared);
  leave_gpu_pose(scene, instance);
  return notes;
}

PoseNotes set_clip(Scene& scene, nook_instance_id id, Ref<const LoadedClips> clips, const FrameMix& mix,
                   const Mat3x4& place) {
  Instance& instance = instance_of(scene, id);
  const CharacterModel& model = instance.model->model;
  if (clips->model.get() != instance.model.get())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the clips were not loaded for the model of instance %u; load them with this model", id);
  const PoseNotes notes = notes_of_place(model, place);
  if (notes.is_place_uneven && scene.settings.strict_poses) fail_uneven(model, notes.first, notes.axes);
  need_own_parts(scene, instance);
  const std::span<Mat3x4> posed(scene.converted.data(), model.bone_count());
  for (std::size_t b = 0; b < posed.size(); ++b) {
    posed[b] = decode_bone(clips->set, mix, place, b);
    check_size(model, b, posed[b]);
  }
  InstanceClip& clip = instance.input.clip;
  clip.mix = mix;
  clip.is_late = false;
  clip.clips = std::move(clips);
  take_pose(instance, posed);
  leave_gpu_pose(scene, instance);
  std::fill(instance.parts->uneven.begin(), instance.parts->uneven.end(), notes.is_place_uneven);
  return notes;
}

void link(Scene& scene, nook_instance_id receiver, nook_instance_id caster) {
  Instance& instance = instance_of(scene, receiver);
  Instance& casting = instance_of(scene, caster);
  if (receiver == caster)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "receiver and caster are the same instance %u; leave out this link, because an instance "
                  "always shadows itself",
                  receiver);
  const std::uint32_t slot = slot_of(scene, casting);
  if (std::binary_search(instance.input.linked.begin(), instance.input.linked.end(), slot)) return;
  make_room_for_one(instance.input.linked);
  make_room_for_one(casting.input.receivers);
  instance.plan.casters.reserve(instance.input.linked.capacity() + scene.nearest);
  insert_slot(instance.input.linked, slot);
  insert_slot(casting.input.receivers, slot_of(scene, instance));
}

void unlink(Scene& scene, nook_instance_id receiver, nook_instance_id caster) {
  Instance& instance = instance_of(scene, receiver);
  Instance& casting = instance_of(scene, caster);
  if (!erase_slot(instance.input.linked, slot_of(scene, casting)))
    throw Failure(NOOK_ERROR_INVALID_HANDLE,
                  "instance %u is not linked to caster %u; nook_scene_unlink removes only links that "
                  "nook_scene_link made",
                  receiver, caster);
  erase_slot(casting.input.receivers, slot_of(scene, instance));
}

void link_nearest(Scene& scene, std::uint32_t k, float max_distance) {
  if (k > max_nearest)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "k is too large (got %u, need at most %u)", k, max_nearest);
  if (k > 0) check_fits("max_distance", max_distance, max_distance > 0, "finite metres above 0");
  for (Instance& instance : scene.instances) instance.plan.casters.reserve(instance.input.linked.size() + k);
  if (k > 0) reserve_tree(scene.neighbours, std::bit_ceil(scene.instances.size()));
  scene.nearest = k;
  scene.nearest_max_distance = max_distance;
}

void set_ground(Scene& scene, nook_instance_id id, const Plane* plane) {
  Instance& instance = instance_of(scene, id);
  if (plane && !(std::abs(length(plane->normal) - 1) <= 1e-3f))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the normal of the plane is not of unit length (got %g, need 1 within 0.001)",
                  double(length(plane->normal)));
  if (plane)
    check_fits("the offset of the plane", plane->offset, std::abs(plane->offset) <= 1e9f, "finite metres");
  instance.input.has_ground = plane != nullptr;
  if (plane) instance.input.ground = *plane;
}

namespace {

void check_occluder(const Sphere& sphere) {
  const Vec3 c = sphere.centre;
  if (!(std::abs(c.x) <= 1e9f && std::abs(c.y) <= 1e9f && std::abs(c.z) <= 1e9f))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the centre is out of range (got %g %g %g, need finite metres)", double(c.x), double(c.y),
                  double(c.z));
  check_fits("the radius", sphere.radius, sphere.radius > 0 && sphere.radius <= 1e9f,
             "finite metres above 0");
}

}  // namespace

nook_occluder_id add_occluder(Scene& scene, const Sphere& sphere, nook_instance_id receiver) {
  check_occluder(sphere);
  if (receiver) instance_of(scene, receiver);
  const std::uint32_t slot = next_slot(scene.occluders, scene.free_occluders, "occluders");
  const bool fresh = slot == scene.occluders.size();
  for (Instance& instance : scene.instances)
    if (instance.id) instance.plan.occluders.reserve(std::bit_ceil(slot + 1));
  if (fresh)
    scene.occluders.emplace_back();
  else
    scene.free_occluders.pop_back();
  Occluder& occluder = scene.occluders[slot];
  occluder.id = occluder.generation << id_slot_bits | (slot + 1);
  occluder.sphere = sphere;
  occluder.receiver = receiver;
  ++scene.structure_revision;
  return occluder.id;
}

void set_occluder(Scene& scene, nook_occluder_id id, const Sphere& sphere, nook_instance_id receiver) {
  check_occluder(sphere);
  Occluder& occluder = find(scene.occluders, id, "occluder");
  if (receiver) instance_of(scene, receiver);
  occluder.sphere = sphere;
  occluder.receiver = receiver;
}

void remove_occluder(Scene& scene, nook_occluder_id id) {
  Occluder& occluder = find(scene.occluders, id, "occluder");
  occluder.id = 0;
  ++occluder.generation;
  const auto slot = static_cast<std::uint32_t>(&occluder - scene.occluders.data());
  if (occluder.generation < id_generations) scene.free_occluders.push_back(slot);
  ++scene.structure_revision;
}

}  // namespace nook
