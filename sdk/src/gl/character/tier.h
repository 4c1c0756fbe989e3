// A tier evaluates characters on one kind of OpenGL. This is the interface of all tiers. A tier owns the
// buffers of all scenes that it evaluates, and of the models of these scenes. The tier is chosen by the
// context's abilities (functions.h).
#pragma once

#include "sdk/src/character/scene.h"
#include "sdk/src/gl/character/budget.h"
#include "sdk/src/gl/character/pose_batch.h"
#include "sdk/src/gl/device.h"

namespace nook::gl {

// The values of an instance's vertices in a buffer.
struct VertexValues {
  GLuint buffer = 0;
  std::uint64_t offset = 0;    // bytes
  std::uint32_t vertices = 0;  // number of vertices in the model's file
  std::uint32_t channels = 1;  // floats for each vertex

  std::uint64_t bytes() const { return std::uint64_t{vertices} * channels * sizeof(float); }
};

// The view of an instance in a scene with a pool.
struct PooledView {
  VertexValues values;
  std::uint32_t generation = 0;  // another number after each change of `values`
  bool is_near = false;
};

// The result of the last assignment of a pool's places.
struct PoolCount {
  std::uint32_t near = 0;     // instances that have a place
  std::uint32_t waiting = 0;  // instances that are near enough, but got no place because the pool is full
};

// The table of a pool on the GPU.
struct PoolTablePlace {
  GLuint buffer = 0;
  std::uint32_t entries = 0;
  std::uint32_t ao_buffers = 0;  // number of buffers with the AO of a model's near instances
};

// What a scene in streaming mode still has to do.
struct StreamLeft {
  std::uint32_t pending = 0;   // instances
  bool has_new_views = false;  // the next update gives an instance another generation
};

struct LightPlace {
  VertexValues directional_ao;
  GLuint texture = 0;  // the texture that contains the lights
  std::uint32_t first_texel = 0;
};

// OpenGL memory in bytes: the memory that all instances of a model share, and the memory of each instance.
struct ModelMemory {
  std::uint64_t shared = 0;
  std::uint64_t instance = 0;
  std::uint64_t light = 0;  // additional memory of an instance with a light
};

// Every call except const ones may change any OpenGL state in touched_state.h, so the caller must hold a
// StateGuard.
class Tier {
 public:
  Tier() = default;
  Tier(const Tier&) = delete;
  Tier& operator=(const Tier&) = delete;
  virtual ~Tier() = default;

  // Assigns a place to every instance of the scene, and makes all buffers and programs that its update needs.
  // The call is cheap if nothing has changed. Throws Failure. What was created until then is kept, and the
  // next call continues from there.
  virtual void prepare(const Scene& scene) = 0;
  // Evaluates a prepared scene, or the instances of a scene in streaming mode that are ready. If it throws
  // Failure, the next update evaluates the missing instances.
  virtual void update(Scene& scene) = 0;

  // Sets the poses of instances of a prepared scene from the host's buffer. If it throws Failure, nothing has
  // changed.
  virtual void set_poses(Scene& scene, const PoseBatch& batch) = 0;
  // Copies the bones of an instance, in world space, and waits for the GPU. Throws Failure.
  virtual void read_pose(const Scene& scene, nook_instance_id instance, std::span<Mat3x4> bones) const = 0;

  // Puts a scene into streaming mode, and compiles the programs that it may need. Throws Failure.
  virtual void set_streaming(const Scene& scene, std::uint32_t fade_updates) = 0;
  virtual bool is_streaming(const Scene& scene) const = 0;
  // Prepares pending instances of a scene in streaming mode as long as there is time. Throws Failure.
  virtual StreamLeft prepare_within(const Scene& scene, const Budget& budget) = 0;

  // Returns where the AO of an instance is. Throws Failure if the instance has no place.
  virtual VertexValues place(const Scene& scene, nook_instance_id instance) const = 0;
  // The same for a scene with a pool or in streaming mode.
  virtual PooledView pooled_view(const Scene& scene, nook_instance_id instance) const = 0;
  virtual PoolCount pool_count(const Scene& scene) const = 0;
  // Returns the table of a prepared scene with a pool. From the first call on, the tier keeps the table
  // current. Copies as many names of the model's AO buffers as fit. Throws Failure.
  virtual PoolTablePlace pool_table(const Scene& scene, const LoadedModel& model,
                                    std::span<GLuint> ao_buffers) = 0;
  // Throws Failure unless the last update saw a light on the instance.
  virtual LightPlace light_place(const Scene& scene, nook_instance_id instance) const = 0;

  // Copies values to `out`, and waits for the GPU. Throws Failure.
  virtual void read(const VertexValues& values, float* out) const = 0;

  // Returns the memory that a model needs. The model need not be in use.
  virtual ModelMemory memory_of(const LoadedModel& model) const = 0;

  virtual void release(const Scene& scene) = 0;
};

}  // namespace nook::gl
