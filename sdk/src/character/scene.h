// A scene as plain data, and the steps that evaluate it. The CPU path runs all of them. The GPU path runs
// only the first, resolve_casters, on the CPU; shaders do the rest from the same fields. World space, metres.
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
#include "sdk/src/character/pose_source.h"
#include "sdk/src/core/aligned_array.h"
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

// Proxy spheres in world space. Pointers are into InstanceArrays::storage, except for caster_weight, which
// belongs to the model.
struct SphereLanes {
  float *x = nullptr, *y = nullptr, *z = nullptr;
  float* inverse_radius = nullptr;  // per metre
  std::uint32_t count = 0;
};

// Key points in world space, each array padded_count long. Padding holds finite numbers. Pointers are into
// InstanceArrays::storage.
struct PointLanes {
  float *x = nullptr, *y = nullptr, *z = nullptr;                          // fitted position, for self-shadow
  float *nx = nullptr, *ny = nullptr, *nz = nullptr;                       // fitted unit normal
  float *surface_x = nullptr, *surface_y = nullptr, *surface_z = nullptr;  // where added casters act
  float *surface_nx = nullptr, *surface_ny = nullptr, *surface_nz = nullptr;
  float* norm_sum = nullptr;       // sum over spheres of (solid angle * visibility)^gamma
  float* shadow = nullptr;         // the model's shadow: norm_sum^(1 / gamma), saturated
  float* optical_depth = nullptr;  // composed form: sum over casters of solid_depth
  float* open = nullptr;           // composed form: product over ground and occluders of 1 - form factor
  float* added = nullptr;          // composed form: 1 - open * exp(-optical_depth); 0 is unshadowed
  PointCodes shadow_codes;         // codes of shadow and, if has_added, of added, for the linear layer
  PointCodes added_codes;
  std::uint32_t count = 0;
  std::uint32_t padded_count = 0;
};

// The pointers of each struct, in the order of their lanes in InstanceArrays::storage and codes. These lists
// determine the number of lanes.
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

// If you add a pointer to a struct, this fails until its list has it too.
static_assert(sizeof(SphereLanes) / sizeof(float*) == sphere_lanes + 1);
static_assert(sizeof(GroupLanes) / sizeof(float*) == group_lanes + 1);
static_assert(sizeof(PointLanes) == point_lanes * sizeof(float*) +
                                        std::size(point_code_members) * sizeof(PointCodes) +
                                        2 * sizeof(std::uint32_t));

struct InstanceArrays {
  SphereLanes spheres;  // full detail
  std::array<GroupLanes, group_tiers> groups;
  std::array<SphereLanes, CharacterModel::max_levels> coarse_spheres;
  // At a coarser level the position and normal lanes hold the evaluated key points only; shadow and added are
  // always complete.
  PointLanes points;
  AlignedArray<float> storage;
  AlignedArray<std::int32_t> codes;
};
InstanceArrays make_instance_arrays(const LoadedModel& model, Memory* memory);

// The clip that gives an instance its pose and its own AO.
struct InstanceClip {
  explicit InstanceClip(Memory* memory) : weights(memory) {}

  Ref<const LoadedClips> clips;  // null: the host sets the pose, and the model computes the self-shadow
  Vector<float> weights;         // of the modes of AO, for the time of the last set_clip
  bool is_used() const { return bool(clips); }
};

// What the host set for an instance, and what follows from it alone.
struct InstanceInput {
  explicit InstanceInput(Memory* memory)
      : bones(memory), uneven(memory), linked(memory), receivers(memory), clip(memory) {}

  Vector<Mat3x4> bones;             // rest space to world, one for each bone of the model
  std::uint64_t pose_revision = 0;  // rises with every set_pose; never 0 for a living instance
  bool is_posed_on_gpu = false;     // the GPU has the pose, and `bones` an earlier one (gpu_pose.h)
  UnevenBones uneven;               // of the present pose
  std::uint32_t reported = 0;       // PoseNotes topics of this instance that were already logged
  bool has_ground = false;
  Plane ground;
  Vector<std::uint32_t> linked;  // slots that the host linked as casters, ascending
  // Slots of the instances that have this one in `linked`, ascending. Removing this instance must visit them.
  Vector<std::uint32_t> receivers;
  InstanceClip clip;
  // `bound` contains all key points and proxy spheres of the pose; its centre is the model's bounding centre,
  // moved by the root bone. `scale` is an upper bound of the bones' scales.
  Sphere bound;
  float scale = 1;
  // The largest scale of the bones, which is also the scale of the body's place.
  float largest_scale() const { return scale / scale_margin; }
  // A matrix within the admitted unevenness and shear lengthens a vector by less than 2 % more than the
  // longest axis.
  static constexpr float scale_margin = 1.02f;
};

// The radius of the sphere that stands for the ground, divided by the bounding radius of the body. For a
// point at one bounding radius above the ground, the sphere's edge lies 0.0135 rad below the horizon. Float
// precision places the sphere to 1e-3 bounding radii.
inline constexpr float default_ground_radii = 11'000;

// What resolve_casters decided for an update. If an instance is not due, its lists come from an earlier
// update; they may name free slots and must not be read.
struct InstancePlan {
  explicit InstancePlan(Memory* memory) : casters(memory), occluders(memory) {}

  Vector<std::uint32_t> casters;    // slots, ascending, each once; capacity reserved by the edits
  Vector<std::uint32_t> occluders;  // slots of free occluders that darken this instance
  Sphere ground_sphere;             // radius 0: no ground, or it is skipped
  std::uint32_t culled = 0;         // casters and occluders below the cut-off
  std::uint32_t level = 0;          // level of detail of the model, 0 is full
  bool due = true;                  // evaluated in this update; other instances keep their results
  std::uint64_t frame = 0;          // Scene::frame in which the lists were made; 0: never
};

// The results of an evaluation on the CPU.
struct InstanceResult {
  InstanceArrays arrays;
  std::uint64_t transformed_revision = 0;  // pose_revision that the spheres in `arrays` show
  std::uint64_t coarse_revision = 0;       // pose_revision that the coarse spheres show
  std::uint64_t grouped_revision = 0;      // pose_revision that the groups show
  Receiver receiver;                       // the key points' surface; kept only if casters may be grouped
  std::uint64_t evaluated_frame = 0;       // Scene::frame of the last evaluation; 0: never
  std::uint64_t evaluations = 0;           // sphere-key-point pairs of the last evaluation
  bool has_added = false;                  // PointLanes::added of the last evaluation has a number other than
                                           // zero
};

// The world casters of an instance in its pose, see pose_world_casters.
struct InstanceCasters {
  explicit InstanceCasters(Memory* memory) : posed(memory) {}

  Vector<PosedCaster> posed;  // one for each caster of the model, which may have none
  Sphere bound;               // holds all of them
  float strength = 0;  // square metres; the AO that they take at the distance d is at most strength / d^2
  std::uint64_t posed_revision = 0;  // InstanceInput::pose_revision of the above; 0: never posed
};

struct Instance {
  explicit Instance(Memory* memory) : input(memory), plan(memory), casters(memory) {}

  nook_instance_id id = 0;        // 0: this slot is free, and everything below except `generation` is empty
  std::uint32_t generation = 0;   // how often the slot was used before; part of the id
  std::uint64_t added_frame = 0;  // Scene::frame when it was added
  Ref<const LoadedModel> model;

  InstanceInput input;
  InstancePlan plan;
  InstanceResult result;
  InstanceLight light;
  InstanceCasters casters;
};

struct Occluder {
  nook_occluder_id id = 0;  // 0: this slot is free
  std::uint32_t generation = 0;
  Sphere sphere;
  nook_instance_id receiver = 0;  // the only instance that it darkens; 0: every instance
};

struct SceneSettings {
  nook_form form = NOOK_FORM_DEFAULT;
  nook_isa isa = NOOK_ISA_AUTO;
  float cutoff_error = 1.0f / 1024;  // AO
  float far_error = 1.0f / 1024;     // AO, rms
  float lod_error = 0;               // AO, rms at lod_distance
  float lod_distance = 10;           // metres
  std::uint32_t lod_max_interval = 1;
  float ground_radius = 0;    // metres; 0: default_ground_radii of the body
  bool strict_poses = false;  // uneven matrices of set_pose fail instead of being projected
};

struct Scene {
  // Throws Failure if the processor lacks settings.isa.
  Scene(const SceneSettings& scene_settings, const Parallel& host_parallel, Memory* scene_memory);

  SceneSettings settings;
  const ShadowKernels* kernels;  // of settings.isa
  Parallel parallel;
  Memory* memory;

  Vector<Instance> instances;            // by slot
  Vector<std::uint32_t> free_instances;  // slots
  Vector<Occluder> occluders;            // by slot
  Vector<std::uint32_t> free_occluders;
  std::uint32_t living = 0;        // instances in use
  std::uint32_t posed_on_gpu = 0;  // instances whose pose is on the GPU
  // Rises when an instance or occluder is added or removed, or an instance gets its first light.
  std::uint64_t structure_revision = 0;

  std::uint32_t nearest = 0;       // k of link_nearest; 0: off
  float nearest_max_distance = 0;  // metres
  NeighbourTree neighbours;
  bool has_camera = false;
  Vec3 camera;
  std::uint32_t terms = NOOK_TERM_ALL;

  // Space to convert a whole pose before it is set.
  Vector<Mat3x4> converted;
  UnevenBones converted_uneven;

  std::uint64_t frame = 0;  // updates so far
  nook_scene_info stats{};  // without memory_bytes
};

// ---- Edits: on a bad id or value they throw Failure, without memory std::bad_alloc, and change nothing ----
nook_instance_id add_instance(Scene& scene, Ref<const LoadedModel> model);
void remove_instance(Scene& scene, nook_instance_id id);
Instance& instance_of(Scene& scene, nook_instance_id id);
const Instance& instance_of(const Scene& scene, nook_instance_id id);
// Keeps the pose, links, ground and light; the bone counts must be equal.
void set_model(Scene& scene, nook_instance_id id, Ref<const LoadedModel> model);
// Uneven matrices are projected unless settings.strict_poses is set.
PoseNotes set_pose(Scene& scene, nook_instance_id id, std::span<const Mat3x4> bones);
PoseNotes set_pose(Scene& scene, nook_instance_id id, PoseSource source);
// Sets the pose of a clip, and its AO in place of self-shadow until the next set_pose. Only the place can be
// uneven.
PoseNotes set_clip(Scene& scene, nook_instance_id id, Ref<const LoadedClips> clips, const FrameMix& mix,
                   const Mat3x4& place);
void link(Scene& scene, nook_instance_id receiver, nook_instance_id caster);
void unlink(Scene& scene, nook_instance_id receiver, nook_instance_id caster);
void link_nearest(Scene& scene, std::uint32_t k, float max_distance);
void set_ground(Scene& scene, nook_instance_id id, const Plane* plane);
// receiver 0: every instance.
nook_occluder_id add_occluder(Scene& scene, const Sphere& sphere, nook_instance_id receiver = 0);
void set_occluder(Scene& scene, nook_occluder_id id, const Sphere& sphere, nook_instance_id receiver = 0);
void remove_occluder(Scene& scene, nook_occluder_id id);

// An id has the slot + 1 in its low bits and the slot's generation in the high ones. A slot whose generations
// are used up is never used again, so that no id occurs twice.
inline constexpr std::uint32_t id_slot_bits = 20;
inline constexpr std::uint32_t id_generations = 1u << (32 - id_slot_bits);
inline constexpr std::uint32_t max_slots = (1u << id_slot_bits) - 1;

// ---- Steps of an update, in order; none allocates or throws ----

// Tells whether the scene's evaluator, the CPU or a GPU, has results for the instance in a slot. It refers to
// a function object, which must outlive it.
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

// Chooses levels of detail and the instances that are due, among them all without results. Then chooses
// casters, occluders and ground sphere for each of these: explicit links and the k nearest, but none below
// the cut-off. Needs only the poses.
void resolve_casters(Scene& scene, HasResult has_result) noexcept;
// Computes the world-space spheres of an instance at the levels that it and its receivers may need.
void transform_spheres(const Scene& scene, Instance& instance) noexcept;
// Merges the spheres of an instance that may darken others into groups, unless settings.far_error is 0.
void group_spheres(const Scene& scene, Instance& instance) noexcept;
// Computes the world-space key points of an instance that is due, at its level, and their box.
void transform_key_points(const Scene& scene, Instance& instance) noexcept;
// Computes shadow and added occlusion at the key points of an instance that is due, and their colours if it
// has a light (instance_light.h).
void evaluate_shadows(const Scene& scene, Instance& instance) noexcept;
// Runs all of the above for all instances, and computes the statistics.
void update(Scene& scene) noexcept;

// Blends the key points to vertices and writes the AO of the last update in file order; `out` has the model's
// number of file vertices, stride_bytes apart.
void read_ao(const Scene& scene, const Instance& instance, float* out, std::size_t stride_bytes) noexcept;
// The same, with numbers of `format`.
void read_ao_as(const Scene& scene, const Instance& instance, nook_format format, void* out,
                std::size_t stride_bytes) noexcept;
// Writes three floats for each vertex in the way of read_ao: directional occlusion, by channel. All three are
// AO if the last update found no light.
void read_directional_ao(const Scene& scene, const Instance& instance, float* out,
                         std::size_t stride_bytes) noexcept;

// Poses the casters of an instance if its pose has changed since the last call. Neither allocates nor throws.
void pose_world_casters(Instance& instance) noexcept;

// An occluder as a caster.
inline PosedCaster caster_of(const Sphere& sphere) {
  return {{sphere.centre, sphere.centre, sphere.radius, sphere.radius}, 1};
}

// Returns a strength such that the caster takes at most strength / d^2 of AO at a distance d. It bounds the
// form factor of the caster's silhouette by a disc and a rectangle that face the point.
float caster_strength(const PosedCaster& caster);

}  // namespace nook
