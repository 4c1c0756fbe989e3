// How the compute tier stores characters: models, which do not change, scenes, and the data of one update.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "sdk/src/gl/character/placed_scene.h"
#include "sdk/src/gl/character/tier.h"
#include "shaders/character/layout.h"

namespace nook::gl {

// Where one level of detail lies in the arrays of its model; level 0 is full detail.
struct LevelRange {
  std::uint32_t first_sphere = 0, spheres = 0;
  std::uint32_t first_key_point = 0, key_points = 0;  // only the evaluated ones
};

// The tables of clips that clip_bones.comp reads, uploaded once.
struct PlacedClips {
  // Throws Failure, UNSUPPORTED if this OpenGL cannot bind a piece this large.
  PlacedClips(Device& device, Ref<const LoadedClips> loaded, std::uint32_t number_in_model);

  std::uint32_t first_weight() const;  // words
  std::uint32_t first_mode() const;

  Ref<const LoadedClips> clips;
  std::uint32_t number;  // of the clips of its model, from 1 on; the records of instances have it
  bool is_used = false;  // by an instance of the scene, at the last look
  Buffer table;
};

struct ComputeModel : ModelData {
  // Throws Failure: UNSUPPORTED if the model is beyond this OpenGL.
  ComputeModel(Device& device, Ref<const LoadedModel> loaded);

  std::uint32_t level_count() const { return static_cast<std::uint32_t>(model->model.levels.size()) + 1; }
  // Returns the level, or the coarsest one if the model has fewer levels.
  const LevelRange& level(std::uint32_t index) const { return levels[std::min(index, level_count() - 1)]; }
  std::uint32_t spheres() const {
    return levels[level_count() - 1].first_sphere + levels[level_count() - 1].spheres;
  }
  // Returns the elements of the stream where an instance's bones are, and before them the place and frames of
  // its clip.
  std::uint32_t bone_uvec4s() const { return std::max(bones() * NOOK_BONE_ROWS, NOOK_CLIP_JOB_UVEC4S + 0u); }
  // Returns how many shadows an instance stores: one for each key point, then one for each key point that a
  // coarser level evaluates.
  std::uint32_t shadows() const;
  std::uint32_t influence_pairs() const { return (model->model.influences + 1) / 2; }
  // Returns the largest number of bytes that one instance with a light takes in any buffer that is bound as
  // one piece.
  std::uint64_t largest_share() const;

  std::array<LevelRange, CharacterModel::max_levels + 1> levels;

  // Shader storage, laid out as the shaders say.
  Buffer spheres_rest;
  Buffer key_points_rest;
  Buffer linear;
  Buffer spread;  // spreads coarser levels' evaluated key points to all; none without such levels
};

// Returns the sizes of the buffers of a model and of its instances.
ModelMemory compute_memory(const LoadedModel& model);

// A scene in the compute tier: spheres, shadows and AO of its instances, and what the CPU sends for one
// update.

struct ComputeChunk : ChunkData {
  using Model = ComputeModel;
  ComputeChunk(Device& device, ComputeModel& for_model, std::uint32_t instance_capacity);

  ComputeModel* model;
  Buffer shadows;                  // capacity * ComputeModel::shadows, two floats each
  Buffer colours;                  // two vec4 for each of `shadows`; none before the first light
  std::uint32_t first_sphere = 0;  // of place 0, in ComputeScene::spheres

  // For each place, the pose whose spheres the GPU has.
  struct Pose {
    nook_instance_id instance = 0;
    std::uint64_t revision = 0;
    bool operator==(const Pose&) const = default;
  };
  Vector<Pose> transformed;

  // Poses on the GPU, for each place an element and three rows of each bone, as pose_convert.comp writes
  // them; none before the first one. And whose pose is there.
  Buffer posed;
  Vector<Pose> posed_of;
  std::uint64_t posed_vec4s() const { return 1 + std::uint64_t{NOOK_BONE_ROWS} * model->bones(); }

  // The inputs of the current call of set_poses. Elements of 16 bytes from the start of the chunk's piece of
  // ComputeScene::jobs.
  struct PoseFrame {
    std::uint32_t count = 0, seeds = 0;   // instances; those that bring bones of the CPU
    std::uint64_t offset = 0, bytes = 0;  // of the piece
    std::uint32_t next_job = 0, next_seed = 0;
  } poses;
  // For each place, the last call of set_poses that named it.
  Vector<std::uint64_t> pose_call;

  // The CPU's inputs of the current update.
  struct Frame {
    // Evaluated instances come first, level by level. The others only need their spheres.
    std::array<std::uint32_t, CharacterModel::max_levels + 1> due_at_level{};
    std::uint32_t due = 0;
    std::uint32_t lit = 0;                // evaluated instances with a light
    std::uint32_t selected = 0;           // all selected instances
    std::uint32_t posed = 0;              // selected instances whose pose is on the GPU
    std::uint32_t late = 0;               // selected instances whose clip the GPU decodes
    std::uint64_t offset = 0, bytes = 0;  // of the chunk's piece of ComputeScene::stream
    // Elements of 16 bytes from the start of the piece, which begins with the records.
    std::uint32_t bones = 0, casters = 0, lights = 0;
  } frame;
};

struct ComputeScene : PlacedScene<ComputeChunk> {
  ComputeScene(Device& device, const Scene& of);

  // Makes all buffers for the assigned places. Throws Failure.
  void make_buffers(Device& device);
  // Uploads clips that instances use since the last call, and releases clips that none uses. Throws Failure.
  void place_clips(Device& device);
  // Returns the number of an instance's clips, which must be late.
  std::uint32_t number_of_clips(const Instance& instance) const;

  Buffer stream;  // what one update sends, a piece for each chunk
  Buffer jobs;    // what one call of set_poses sends, a piece for each chunk; none before the first one
  std::uint64_t pose_calls = 0;
  Buffer spheres;  // of every place of every chunk
  List<PlacedClips> clips;

 private:
  // Of the scene, when the clips were placed.
  std::uint64_t clips_revision_ = 0, clips_structure_ = 0;
  void make_sphere_buffers(Device& device);
  void make_light_buffers(Device& device);
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

// The data of one update of the compute tier. The records, poses, casters and lights of each chunk's
// instances form one piece of a buffer, which is filled from the start each time.

// Two uvec4, as instance.glsl reads them.
struct InstanceRecord {
  std::uint32_t first_bone;                  // element of the chunk's piece of the stream
  std::uint32_t first_sphere;                // in the scene's spheres
  std::uint32_t place;                       // in the chunk, with NOOK_RECORD_SELF
  std::uint32_t light;                       // element of the piece; 0: none
  std::uint32_t first_caster, caster_count;  // element of the piece
  std::uint32_t first_exact, exact_count;
};
static_assert(sizeof(InstanceRecord) == NOOK_RECORD_UVEC4S * 4 * sizeof(std::uint32_t));

// Lays out and writes what is due or has moved. Returns false if there is nothing to do. Throws Failure if
// OpenGL has no memory.
bool upload_frame(const Device& device, ComputeScene& placed);

}  // namespace nook::gl
