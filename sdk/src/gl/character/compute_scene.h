// How the compute tier stores characters on the GPU: models, which do not change, scenes, and the data of one
// update.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "sdk/src/gl/character/placed_scene.h"
#include "sdk/src/gl/character/pool_table.h"
#include "sdk/src/gl/character/tier.h"
#include "shaders/character/layout.h"

namespace nook::gl {

// The ranges of one level of detail in the arrays of its model. Level 0 is full detail.
struct LevelRange {
  std::uint32_t first_sphere = 0, spheres = 0;
  std::uint32_t first_key_point = 0, key_points = 0;  // only key points that the level evaluates
};

// The tables of clips that clip_bones.comp reads, uploaded once.
struct PlacedClips {
  PlacedClips(Ref<const LoadedClips> loaded, std::uint32_t number_in_model)
      : clips(std::move(loaded)), number(number_in_model) {}

  // Throws Failure, with UNSUPPORTED if the tables are too large to be bound by this OpenGL.
  void upload_piece(Device& device);

  std::uint32_t first_weight() const;  // words
  std::uint32_t first_mode() const;

  Ref<const LoadedClips> clips;
  std::uint32_t number;  // identifies the clips among the clips of its model; starts at 1; the records of
                         // instances contain it
  bool is_used = false;  // true if an instance of the scene used the clips in the last find_clips
  bool is_uploaded = false;
  Buffer table;
  TableUpload upload;
};

struct ComputeModel : ModelData {
  explicit ComputeModel(Ref<const LoadedModel> loaded);

  bool is_uploaded() const { return uploaded_ == table_count; }
  // Throws Failure, with UNSUPPORTED if the model exceeds the limits of this OpenGL.
  void upload_piece(Device& device);

  std::uint32_t level_count() const { return static_cast<std::uint32_t>(model->model.levels.size()) + 1; }
  // Returns the level, or the coarsest one if the model has fewer levels.
  const LevelRange& level(std::uint32_t index) const { return levels[std::min(index, level_count() - 1)]; }
  std::uint32_t spheres() const {
    return levels[level_count() - 1].first_sphere + levels[level_count() - 1].spheres;
  }
  // Returns how many elements the bones of an instance take in the stream. If the instance has a clip, the
  // place and frames of the clip are stored there first.
  std::uint32_t bone_uvec4s() const { return std::max(bones() * NOOK_BONE_ROWS, NOOK_CLIP_JOB_UVEC4S + 0u); }
  // Returns the number of shadows that an instance stores. First there is one for each key point, then one
  // for each key point that a coarser level evaluates.
  std::uint32_t shadows() const;
  std::uint32_t influence_pairs() const { return (model->model.influences + 1) / 2; }
  // Returns how many bytes of one buffer an instance with a light needs at most. Only counts buffers of a
  // chunk that are bound as a whole.
  std::uint64_t largest_share() const;

  std::array<LevelRange, CharacterModel::max_levels + 1> levels;

  // Shader storage buffers. The shaders document their layouts.
  Buffer spheres_rest;
  Buffer key_points_rest;
  Buffer linear;
  Buffer spread;   // table for spread.comp; only for models with several levels
  Buffer open_ao;  // the AO that far and pending instances show, 1 at each vertex

 private:
  static constexpr std::uint32_t table_count = 4;
  bool upload_table(Device& device);
  std::uint32_t uploaded_ = 0;  // tables
  TableUpload upload_;
};

// Returns the sizes of the buffers of a model and of its instances.
ModelMemory compute_memory(const LoadedModel& model);

// A scene in the compute tier: spheres, shadows and AO of its instances, and the data that the CPU sends for
// one update.

struct ComputeChunk : ChunkData {
  using Model = ComputeModel;
  ComputeChunk(Device& device, ComputeModel& for_model, std::uint32_t instance_capacity);

  std::uint64_t spheres() const { return std::uint64_t{capacity} * model->spheres(); }

  ComputeModel* model;
  Buffer shadows;                  // capacity * ComputeModel::shadows, two floats each
  Buffer colours;                  // two vec4 for each element of `shadows`; created for the first light
  std::uint32_t first_sphere = 0;  // index in ComputeScene::spheres of the first sphere of place 0

  // For each place, the pose for which the GPU has computed the spheres.
  struct Pose {
    nook_instance_id instance = 0;
    std::uint64_t revision = 0;
    bool operator==(const Pose&) const = default;
  };
  Vector<Pose> transformed;

  // Poses on the GPU, in the layout that pose_convert.comp writes: for each place, one element and then three
  // rows for each bone. The buffer is created for the first such pose. The next member tells to which
  // instance the pose in a place belongs.
  Buffer posed;
  Vector<Pose> posed_of;
  std::uint64_t posed_vec4s() const { return 1 + std::uint64_t{NOOK_BONE_ROWS} * model->bones(); }

  // The input of the current call of set_poses. Indices count elements of 16 bytes from the start of the
  // chunk's piece of ComputeScene::jobs.
  struct PoseFrame {
    std::uint32_t count = 0, seeds = 0;   // number of instances, and number of instances whose bones the CPU
                                          // sends
    std::uint64_t offset = 0, bytes = 0;  // range of the piece in the buffer
    std::uint32_t next_job = 0, next_seed = 0;
  } poses;
  // The CPU's inputs of the current update.
  struct Frame {
    // The records of evaluated instances come first, level by level. For the other instances, only the
    // spheres are computed.
    std::array<std::uint32_t, CharacterModel::max_levels + 1> due_at_level{};
    std::uint32_t due = 0;
    std::uint32_t lit = 0;                // evaluated instances with a light
    std::uint32_t selected = 0;           // all selected instances
    std::uint32_t posed = 0;              // selected instances whose pose is on the GPU
    std::uint32_t late = 0;               // selected instances whose clip the GPU decodes
    std::uint64_t offset = 0, bytes = 0;  // offset and size of the chunk's piece of ComputeScene::stream
    // Indices of elements of 16 bytes, counted from the start of the piece. The piece begins with the
    // records.
    std::uint32_t bones = 0, casters = 0, lights = 0;
  } frame;
};

struct ComputeScene : PlacedScene<ComputeChunk> {
  ComputeScene(Device& device, const Scene& of);

  // Creates the buffers for all places that place_all has assigned to instances. Throws Failure.
  void make_buffers(Device& device);
  // Uploads the clips that instances have started to use since the last call, and releases clips that no
  // instance uses. Throws Failure.
  void place_clips(Device& device, const Budget& budget);
  // Returns the number of an instance's clips. The bones of the instance must be late
  // (InstanceClip::is_late).
  std::uint32_t number_of_clips(const Instance& instance) const;
  // Returns whether an update can evaluate an instance in streaming mode.
  bool is_ready(std::uint32_t slot) const;
  // Returns how many instances wait for their model or their clips.
  std::uint32_t count_pending() const;
  // Creates buffers for chunks with a light that have none. Throws Failure.
  void make_light_buffers(Device& device);
  // Follows the edits of a scene in streaming mode. Throws Failure.
  void follow_edits(Device& device);
  // Uploads what pending instances need, as long as there is time. Throws Failure.
  void place_within(Device& device, List<ComputeModel>& models, const Budget& budget);

  Buffer stream;  // what one update sends, a piece for each chunk
  Buffer jobs;    // what one call of set_poses sends, a piece for each chunk; created by the first call
  std::uint32_t pose_calls = 0;
  Buffer spheres;  // for every place of every chunk
  List<PlacedClips> clips;

  // The pool of the scene (compute_pool.cpp). Without a pool, the functions do nothing.

  // Reserves the memory that `assign` needs, so that `assign` does not allocate. Throws Failure.
  void make_pool(Device& device);
  // Measures how far each instance is from the camera.
  void measure() noexcept;
  // Gives places to the nearest instances, and takes places from others. Pass the number of the call of
  // set_poses that is about to bring poses to the GPU, or 0. An instance whose pose is on the GPU can only
  // get a place in such a call, because its pose is not kept for later.
  void assign(Scene& scene_to_change, std::uint32_t call) noexcept;
  // Call this after an update, which has computed the AO of new instances of the pool.
  void finish_assigned(Scene& scene_to_change) noexcept;
  PooledView pooled_view(nook_instance_id instance) const;
  // Creates the table for the host, or enlarges it if instances were added. Throws Failure.
  void make_table(Device& device);
  // Writes what changed since the last call. Does nothing if the host does not use the table.
  void write_table(const Device& device) noexcept;
  PoolTable table;
  PoolCount pool_count;

 private:
  // An instance that is near enough for a place.
  struct Candidate {
    const LoadedModel* model;
    float distance;
    std::uint32_t slot;
  };
  void choose(std::uint32_t call) noexcept;
  bool may_be_near(std::uint32_t slot, std::uint32_t call) const noexcept;
  void leave(Scene& scene_to_change, std::uint32_t slot) noexcept;
  void enter(Scene& scene_to_change, std::uint32_t slot) noexcept;
  Vector<Candidate> candidates_;

  // Revisions of the scene at the time when the clips were placed.
  std::uint64_t clips_revision_ = 0, clips_structure_ = 0;
  void find_clips();
  // Returns whether the model and the clips of an instance are uploaded.
  bool has_data(std::uint32_t slot) const;
  void make_sphere_buffers(Device& device);
  // Makes a chunk whose spheres lie in a gap of the buffer, or at its end. So the spheres of
  // the other chunks stay. Throws Failure.
  ComputeChunk& add_chunk(Device& device, ComputeModel& model, std::uint32_t instance_capacity);
  void grow_spheres(Device& device, std::uint64_t count);
};

inline void bind_whole(const Functions& gl, GLuint binding, const Buffer& buffer) {
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
}

inline void bind_piece(const Functions& gl, GLuint binding, const Buffer& buffer, std::uint64_t offset,
                       std::uint64_t bytes) {
  gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, buffer.name(), static_cast<GLintptr>(offset),
                     static_cast<GLsizeiptr>(bytes));
}

inline ComputeChunk::Pose pose_of(const Instance& instance) {
  return {instance.id, instance.input.pose_revision};
}

// The data of one update of the compute tier. For each chunk, the records, poses, casters and lights of its
// instances form one piece of a buffer. Every update fills this buffer again from the start.

// Two uvec4, as instance.glsl reads them.
struct InstanceRecord {
  std::uint32_t first_bone;                  // index of an element in the chunk's piece of the stream
  std::uint32_t first_sphere;                // index in the scene's spheres
  std::uint32_t place;                       // the place in the chunk, and flags such as NOOK_RECORD_SELF
  std::uint32_t light;                       // index of an element in the piece; 0: no light
  std::uint32_t first_caster, caster_count;  // index of an element in the piece, and number of casters
  std::uint32_t first_exact, exact_count;
};
static_assert(sizeof(InstanceRecord) == NOOK_RECORD_UVEC4S * 4 * sizeof(std::uint32_t));

// Lays out and writes the data of all instances that are due or have moved. Returns false if there are none.
// Throws Failure if OpenGL has no memory.
bool upload_frame(const Device& device, ComputeScene& placed);

}  // namespace nook::gl
