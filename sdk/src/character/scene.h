// A scene as plain data, and the steps that evaluate it. The CPU path runs all of them. The GPU path runs
// only the first step, resolve_casters, on the CPU. Shaders then compute the other steps from the same
// fields. Positions and lengths are in world space, in metres.
#pragma once

#include <nook/experimental/nook_debug.h>
#include <nook/nook_character.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include "sdk/src/character/instance_light.h"
#include "sdk/src/character/loaded_clips.h"
#include "sdk/src/character/loaded_model.h"
#include "sdk/src/character/neighbours.h"
#include "sdk/src/character/pose_bound.h"
#include "sdk/src/character/pose_source.h"
#include "sdk/src/core/aligned_array.h"
#include "sdk/src/core/box.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/core/geometry.h"
#include "sdk/src/core/parallel.h"

namespace nook {

struct Sphere {
  Vec3 centre;
  float radius = 0;  // 0: none
};

// Points p with dot(normal, p) = offset.
struct Plane {
  Vec3 normal{0, 1, 0};  // unit length
  float offset = 0;
};

// Proxy spheres in world space. The pointers point into InstanceArrays::storage. The caster_weight of the
// spheres is in the model (RestSpheres).
struct SphereLanes {
  float *x = nullptr, *y = nullptr, *z = nullptr;
  float* inverse_radius = nullptr;  // per metre
  std::uint32_t count = 0;
};

// Key points in world space. Each array has padded_count elements; the padding elements are finite. The
// pointers point into InstanceArrays::storage.
struct PointLanes {
  float *x = nullptr, *y = nullptr, *z = nullptr;                          // fitted position, for self-shadow
  float *nx = nullptr, *ny = nullptr, *nz = nullptr;                       // fitted unit normal
  float *surface_x = nullptr, *surface_y = nullptr, *surface_z = nullptr;  // the occlusion by other bodies
                                                                           // and occluders is evaluated here
  float *surface_nx = nullptr, *surface_ny = nullptr, *surface_nz = nullptr;
  float* norm_sum = nullptr;       // sum over spheres of (solid angle * visibility)^gamma
  float* shadow = nullptr;         // the model's self-shadow: norm_sum^(1 / gamma), after saturated() in
                                   // kernel.h
  float* optical_depth = nullptr;  // composed form: sum of solid_depth over the casters
  float* open = nullptr;           // composed form: product over ground and occluders of 1 - form factor
  float* added = nullptr;          // composed form: occlusion by added casters, 1 - open *
                                   // exp(-optical_depth)
  PointCodes shadow_codes;         // `shadow`, encoded for the linear layer
  PointCodes added_codes;
  std::uint32_t count = 0;
  std::uint32_t padded_count = 0;
};

// The pointers of each struct, in the order of their lanes in InstanceArrays::storage and
// InstanceArrays::codes. The lengths of these lists determine the number of lanes.
inline constexpr float* SphereLanes::*sphere_members[] = {&SphereLanes::x, &SphereLanes::y, &SphereLanes::z,
                                                          &SphereLanes::inverse_radius};
inline constexpr float* GroupLanes::*group_members[] = {&GroupLanes::x,
                                                        &GroupLanes::y,
                                                        &GroupLanes::z,
                                                        &GroupLanes::inverse_radius,
                                                        &GroupLanes::caster_weight,
                                                        &GroupLanes::moment};
inline constexpr float* PointLanes::*point_members[] = {
    &PointLanes::x,          &PointLanes::y,          &PointLanes::z,
    &PointLanes::nx,         &PointLanes::ny,         &PointLanes::nz,
    &PointLanes::surface_x,  &PointLanes::surface_y,  &PointLanes::surface_z,
    &PointLanes::surface_nx, &PointLanes::surface_ny, &PointLanes::surface_nz,
    &PointLanes::norm_sum,   &PointLanes::shadow,     &PointLanes::optical_depth,
    &PointLanes::open,       &PointLanes::added};
inline constexpr PointCodes PointLanes::*point_code_members[] = {&PointLanes::shadow_codes,
                                                                 &PointLanes::added_codes};
inline constexpr std::int32_t* PointCodes::*code_members[] = {&PointCodes::low, &PointCodes::high};

inline constexpr std::size_t sphere_lanes = std::size(sphere_members), group_lanes = std::size(group_members),
                             point_lanes = std::size(point_members),
                             code_lanes = std::size(point_code_members) * std::size(code_members);

// If you add a pointer to a struct, these assertions fail until you add it to the struct's list too.
static_assert(sizeof(SphereLanes) / sizeof(float*) == sphere_lanes + 1);
static_assert(sizeof(GroupLanes) / sizeof(float*) == group_lanes + 1);
static_assert(sizeof(PointLanes) == point_lanes * sizeof(float*) +
                                        std::size(point_code_members) * sizeof(PointCodes) +
                                        2 * sizeof(std::uint32_t));

struct InstanceArrays {
  SphereLanes spheres;  // full detail
  std::array<GroupLanes, group_tiers> groups;
  std::array<SphereLanes, CharacterModel::max_levels> coarse_spheres;
  // At a coarser level, the position and normal lanes hold only the evaluated key points. `shadow` and
  // `added` always hold all key points.
  PointLanes points;
  AlignedArray<float> storage;
  AlignedArray<std::int32_t> codes;
};
InstanceArrays make_instance_arrays(const LoadedModel& model, Memory* memory);

// The clip from which an instance gets its pose and the AO of its self-shadow.
struct InstanceClip {
  Ref<const LoadedClips> clips;  // null: the host sets the pose, and the model computes the self-shadow
  FrameMix mix;                  // the time of the last set_clip or set_clips
  // True if InstanceParts::bones still hold an earlier pose, because set_clips sets a pose without its bones.
  // decode_late_bones then computes the bones from `mix` and `place` (scene_clips.h).
  bool is_late = false;
  Mat3x4 place;
  std::uint64_t call = 0;  // the value of Scene::clip_calls at the last set_clips that included this instance
  bool is_used() const { return bool(clips); }
};

// What the host set for an instance, and values that are derived from these settings alone.
struct InstanceInput {
  explicit InstanceInput(Memory* memory) : linked(memory), receivers(memory) {}

  // These fields come first and are next to each other, because set_clips writes them for whole crowds.
  std::uint64_t pose_revision = 0;  // incremented by every set_pose; never 0 for an instance in use
  // `bound` contains all key points and proxy spheres of the pose. Its centre is the model's bounding centre,
  // transformed by the root bone. `scale` is an upper bound of the scales of the bones.
  Sphere bound;
  float scale = 1;
  // True if the current pose is only on the GPU, and InstanceParts::bones hold an earlier one (gpu_pose.h).
  bool is_posed_on_gpu = false;
  bool has_ground = false;
  InstanceClip clip;

  std::uint32_t reported = 0;  // bits of the PoseNotes topics that were already logged for this instance
  Plane ground;
  Vector<std::uint32_t> linked;  // slots of the casters that the host linked, ascending
  // Slots of the instances that have this instance in `linked`, ascending. When this instance is removed, it
  // must be unlinked from them.
  Vector<std::uint32_t> receivers;
  // Returns the largest scale of the bones. It is also the scale of the whole body.
  float largest_scale() const { return scale / scale_margin; }
  static constexpr float scale_margin = bone_scale_margin;
};

// The ground is evaluated as a huge sphere. This is its radius, divided by the bounding radius of the body.
// Seen from one bounding radius above the ground, the edge of this sphere lies 0.0135 rad below the horizon.
// In float precision, the surface of the sphere is exact to 1e-3 bounding radii, which is good enough.
inline constexpr float default_ground_radii = 11'000;

// What resolve_casters decided for an update. If an instance is not due, its lists come from an earlier
// update. Do not read these lists, because they may contain slots that are now free.
struct InstancePlan {
  explicit InstancePlan(Memory* memory) : casters(memory), occluders(memory) {}

  Vector<std::uint32_t> casters;    // slots, ascending, without duplicates; the edit functions reserve the
                                    // capacity
  Vector<std::uint32_t> occluders;  // slots of the free occluders that darken this instance
  Sphere ground_sphere;             // radius 0: the instance has no ground, or the ground is skipped
  std::uint32_t culled = 0;         // number of casters and occluders that were skipped because their effect
                                    // is below cutoff_error
  std::uint32_t level = 0;          // level of detail of the model, 0 is full detail
  bool due = true;                  // evaluated in this update; other instances keep their results
  // True if the instance is in the far form of a pool (scene_pool.h). Then it is never due, and darkens no
  // other instance.
  bool is_far = false;
  std::uint64_t frame = 0;  // Scene::frame in which the lists were made; 0: never
};

// Information about the last evaluation on the CPU. InstanceParts holds the computed values.
struct InstanceResult {
  std::uint64_t transformed_revision = 0;  // pose_revision for which the spheres in `arrays` were computed
  std::uint64_t coarse_revision = 0;       // pose_revision of the coarse spheres
  std::uint64_t grouped_revision = 0;      // pose_revision of the groups
  std::uint64_t evaluated_frame = 0;       // Scene::frame of the last evaluation; 0: never
  std::uint64_t evaluations = 0;           // sphere-key-point pairs of the last evaluation
  bool has_added = false;  // true if PointLanes::added of the last evaluation is not zero everywhere
};

// The world casters of an instance, posed by pose_world_casters.
struct InstanceCasters {
  explicit InstanceCasters(Memory* memory) : posed(memory) {}

  Vector<PosedCaster> posed;  // one for each caster of the model; may be empty
  Sphere bound;               // contains all of `posed`
  float strength = 0;         // square metres; at a distance d, the casters in `posed` together reduce AO by
                              // at most strength / d^2
  std::uint64_t posed_revision = 0;  // InstanceInput::pose_revision for which the fields above were computed;
                                     // 0: never posed
};

// The large data of an instance. In a scene with a pool, an instance has it only while it is near, or after
// the host posed it on the CPU (scene_pool.h).
struct InstanceParts {
  explicit InstanceParts(Memory* memory) : bones(memory), uneven(memory), casters(memory) {}

  Vector<Mat3x4> bones;  // rest space to world, one for each bone; empty in parts that the pool lends
  UnevenBones uneven;    // the projected bones of the current pose
  InstanceArrays arrays;
  Receiver receiver;  // made from the surface positions of the key points; only valid if casters may be
                      // grouped
  InstanceLight light;
  InstanceCasters casters;
};

struct Instance {
  explicit Instance(Memory* memory) : input(memory), plan(memory) {}

  nook_instance_id id = 0;        // 0: this slot is free, and everything below except `generation` is empty
  std::uint32_t generation = 0;   // number of earlier uses of the slot; part of the id
  std::uint64_t added_frame = 0;  // Scene::frame when the instance was added
  Ref<const LoadedModel> model;

  InstanceInput input;
  InstancePlan plan;
  InstanceResult result;
  Box<InstanceParts> parts;

  // These functions read a member of `parts`. If the instance has no parts, the result is empty.
  const Vector<Mat3x4>& bones() const { return read_parts().bones; }
  const UnevenBones& uneven() const { return read_parts().uneven; }
  const InstanceArrays& arrays() const { return read_parts().arrays; }
  const InstanceLight& light() const { return read_parts().light; }
  const InstanceCasters& casters() const { return read_parts().casters; }

 private:
  const InstanceParts& read_parts() const;
};

struct Occluder {
  nook_occluder_id id = 0;  // 0: this slot is free
  std::uint32_t generation = 0;
  Sphere sphere;
  nook_instance_id receiver = 0;  // the only instance that the occluder darkens; 0: it darkens every instance
};

struct SceneSettings {
  nook_form form = NOOK_FORM_DEFAULT;
  nook_isa isa = NOOK_ISA_AUTO;
  float cutoff_error = 1.0f / 1024;  // AO
  float far_error = 1.0f / 1024;     // RMS difference in AO
  float lod_error = 0;               // RMS difference in AO at lod_distance
  float lod_distance = 10;           // metres
  std::uint32_t lod_max_interval = 1;
  float ground_radius = 0;    // metres; 0: default_ground_radii times the body's bounding radius
  bool strict_poses = false;  // if true, set_pose fails for uneven matrices instead of projecting them
};

// The pool of a scene: only near instances have parts and places on the GPU (scene_pool.h).
struct ScenePool {
  explicit ScenePool(Memory* memory) : spare(memory) {}

  std::uint32_t places = 0;  // number of places for each model's instances; 0: the scene has no pool
  float distance = 0;        // metres; instances up to this distance from the camera can get a place
  Vector<Box<InstanceParts>> spare;
  std::uint32_t made = 0;  // number of parts that exist, spare or lent
  // Scene::structure_revision for which enough parts were made.
  std::uint64_t reserved_revision = 0;
  std::uint32_t generation = 0;  // incremented when the view of an instance changes
  bool is_used() const { return places > 0; }
};

struct Scene {
  // Throws Failure if the processor lacks settings.isa.
  Scene(const SceneSettings& scene_settings, const Parallel& host_parallel, Memory* scene_memory);

  SceneSettings settings;
  const ShadowKernels* kernels;  // for settings.isa
  Parallel parallel;
  Memory* memory;

  Vector<Instance> instances;            // by slot
  Vector<std::uint32_t> free_instances;  // slots
  Vector<Occluder> occluders;            // by slot
  Vector<std::uint32_t> free_occluders;
  std::uint32_t living = 0;        // instances in use
  std::uint32_t posed_on_gpu = 0;  // instances whose pose is on the GPU
  // Incremented when an instance or occluder is added or removed, and when an instance gets its first light.
  std::uint64_t structure_revision = 0;
  std::uint64_t clip_calls = 0;  // number of calls of set_clips so far
  // Incremented when set_clips gives an instance different clips. A GPU path may then have to upload the
  // tables of these clips.
  std::uint64_t clips_revision = 0;

  std::uint32_t nearest = 0;       // k of link_nearest; 0: off
  float nearest_max_distance = 0;  // metres
  NeighbourTree neighbours;
  bool has_camera = false;
  Vec3 camera;
  std::uint32_t terms = NOOK_TERM_ALL;

  // False while only shaders update the scene. Then the instances have no InstanceArrays, and their lights
  // have no InstanceLight::storage.
  bool has_arrays = true;
  // True after the first update on the CPU. Then the instances keep their arrays, because the host reads the
  // results from them.
  bool was_updated_on_cpu = false;

  // Scratch memory. A whole pose is converted here before it is set, so that an invalid transform changes
  // nothing.
  Vector<Mat3x4> converted;
  UnevenBones converted_uneven;

  ScenePool pool;

  std::uint64_t frame = 0;  // number of updates so far
  nook_scene_info stats{};  // all fields except memory_bytes
};

// ---- Edits: throw Failure for a bad id or value, and std::bad_alloc if memory runs out; after a throw, the
// scene is unchanged ----
nook_instance_id add_instance(Scene& scene, Ref<const LoadedModel> model);
void remove_instance(Scene& scene, nook_instance_id id);
Instance& instance_of(Scene& scene, nook_instance_id id);
const Instance& instance_of(const Scene& scene, nook_instance_id id);
// Replaces the model of an instance, and keeps its pose, links, ground and light. Both models must have the
// same number of bones.
void set_model(Scene& scene, nook_instance_id id, Ref<const LoadedModel> model);
// Both overloads project uneven matrices, unless settings.strict_poses is set.
PoseNotes set_pose(Scene& scene, nook_instance_id id, std::span<const Mat3x4> bones);
PoseNotes set_pose(Scene& scene, nook_instance_id id, PoseSource source);
// Sets a pose from a clip. Until the next set_pose, the instance uses the clip's AO instead of computing
// self-shadow. Only the matrix `place` can be uneven.
PoseNotes set_clip(Scene& scene, nook_instance_id id, Ref<const LoadedClips> clips, const FrameMix& mix,
                   const Mat3x4& place);
void link(Scene& scene, nook_instance_id receiver, nook_instance_id caster);
void unlink(Scene& scene, nook_instance_id receiver, nook_instance_id caster);
void link_nearest(Scene& scene, std::uint32_t k, float max_distance);
void set_ground(Scene& scene, nook_instance_id id, const Plane* plane);
// If `receiver` is 0, the occluder darkens every instance.
nook_occluder_id add_occluder(Scene& scene, const Sphere& sphere, nook_instance_id receiver = 0);
void set_occluder(Scene& scene, nook_occluder_id id, const Sphere& sphere, nook_instance_id receiver = 0);
void remove_occluder(Scene& scene, nook_occluder_id id);
// Allocates the InstanceArrays of every instance, for updates on the CPU. Instances that are added later get
// their arrays too. Allocates only after leave_arrays. Throws std::bad_alloc.
void make_arrays(Scene& scene);
// Releases the arrays of make_arrays, because shaders update the scene. Does nothing after an update on the
// CPU, because the arrays then hold its results.
void leave_arrays(Scene& scene) noexcept;

// An id holds the slot + 1 in its low bits and the slot's generation in its high bits. When all generations
// of a slot are used up, the slot is never used again, so every id is unique.
inline constexpr std::uint32_t id_slot_bits = 20;
inline constexpr std::uint32_t id_generations = 1u << (32 - id_slot_bits);
inline constexpr std::uint32_t max_slots = (1u << id_slot_bits) - 1;

// ---- Steps of an update, in order; none allocates or throws ----

// Asks the evaluator, which is the CPU path or a GPU path, whether it has results for the instance in a slot.
// HasResult only keeps a reference to `function`, so the function object must outlive it.
class HasResult {
 public:
  template <class Function>
  HasResult(const Function& function)
      : function_(&function), ask_([](const void* of, std::uint32_t slot) {
          return bool((*static_cast<const Function*>(of))(slot));
        }) {}
  bool operator()(std::uint32_t slot) const { return ask_(function_, slot); }

 private:
  const void* function_;
  bool (*ask_)(const void* of, std::uint32_t slot);
};

// First chooses the levels of detail, and the instances that are evaluated in this update ("due"). An
// instance without results is always due. Then chooses casters, occluders and the ground sphere for each
// instance that is due. The casters are the linked instances and the k nearest instances. Casters whose
// effect is below cutoff_error are skipped. This step needs only the poses.
void resolve_casters(Scene& scene, HasResult has_result) noexcept;
// Computes the world-space spheres of an instance at the levels that it and its receivers may need.
void transform_spheres(const Scene& scene, Instance& instance) noexcept;
// Merges the spheres of an instance into groups, if the instance may darken others. Does nothing if
// settings.far_error is 0.
void group_spheres(const Scene& scene, Instance& instance) noexcept;
// Computes the world-space key points of an instance at its level, and their bounding box. The instance must
// be due.
void transform_key_points(const Scene& scene, Instance& instance) noexcept;
// Computes shadow and added occlusion at the key points of an instance. If the instance has a light, also
// computes their colours (instance_light.h). The instance must be due.
void evaluate_shadows(const Scene& scene, Instance& instance) noexcept;
// Runs all steps above for all instances, and computes the statistics. The instances must have their arrays.
void update(Scene& scene) noexcept;

// Computes the AO of the vertices from the key points of the last update, and writes it in file order. `out`
// holds one value for each file vertex of the model, stride_bytes apart.
void read_ao(const Scene& scene, const Instance& instance, float* out, std::size_t stride_bytes) noexcept;
// Like read_ao, but writes the values in the format `format`.
void read_ao_as(const Scene& scene, const Instance& instance, nook_format format, void* out,
                std::size_t stride_bytes) noexcept;
// Like read_ao, but writes three floats for each vertex: the directional occlusion of each colour channel. If
// the instance had no light in the last update, all three are its AO.
void read_directional_ao(const Scene& scene, const Instance& instance, float* out,
                         std::size_t stride_bytes) noexcept;

// Poses the world casters of an instance if its pose has changed since the last call. Does not allocate or
// throw.
void pose_world_casters(Instance& instance) noexcept;

// Returns an occluder as a caster.
inline PosedCaster caster_of(const Sphere& sphere) {
  return {{sphere.centre, sphere.centre, sphere.radius, sphere.radius}, 1};
}

// Returns the strength of a caster, in square metres. At a distance d, the caster reduces AO by at most
// strength / d^2. The bound is the form factor of a disc and a rectangle that cover the caster's silhouette
// and face the point.
float caster_strength(const PosedCaster& caster);

}  // namespace nook
