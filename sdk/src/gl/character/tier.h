// The interface of a tier, which evaluates characters on one kind of OpenGL. A tier owns the buffers of every
// scene that it evaluates and of the models of these scenes. Which tier runs depends on the context's
// abilities (functions.h).
#pragma once

#include "sdk/src/character/scene.h"
#include "sdk/src/gl/character/pose_batch.h"
#include "sdk/src/gl/device.h"

namespace nook::gl {

// The values of an instance's vertices in a buffer.
struct VertexValues {
  GLuint buffer = 0;
  std::uint64_t offset = 0;    // bytes
  std::uint32_t vertices = 0;  // as in the model's file
  std::uint32_t channels = 1;  // floats for each vertex

  std::uint64_t bytes() const { return std::uint64_t{vertices} * channels * sizeof(float); }
};

struct LightPlace {
  VertexValues directional_ao;
  GLuint texture = 0;  // of the lights
  std::uint32_t first_texel = 0;
};

// OpenGL memory in bytes: what the instances of a model share, and what each takes.
struct ModelMemory {
  std::uint64_t shared = 0;
  std::uint64_t instance = 0;
  std::uint64_t light = 0;  // what a light adds to an instance
};

// Every call except const ones may change any of the touched state; the caller must hold a StateGuard.
class Tier {
 public:
  Tier() = default;
  Tier(const Tier&) = delete;
  Tier& operator=(const Tier&) = delete;
  virtual ~Tier() = default;

  // Assigns a place to every instance of the scene, and makes all buffers and programs that its update needs.
  // It is cheap if nothing has changed. Throws Failure; the next call continues with what was made until
  // then.
  virtual void prepare(const Scene& scene) = 0;
  // Evaluates a prepared scene. Throws Failure; the next update makes up for this one.
  virtual void update(Scene& scene) = 0;

  // Sets the poses of instances of a prepared scene from the host's buffer. Throws Failure before anything
  // changes.
  virtual void set_poses(Scene& scene, const PoseBatch& batch) = 0;
  // Copies the bones of an instance, in world space, and waits for the GPU. Throws Failure.
  virtual void read_pose(const Scene& scene, nook_instance_id instance, std::span<Mat3x4> bones) const = 0;

  // Throws Failure unless the instance has a place.
  virtual VertexValues place(const Scene& scene, nook_instance_id instance) const = 0;
  // Throws Failure unless the last update saw a light on the instance.
  virtual LightPlace light_place(const Scene& scene, nook_instance_id instance) const = 0;

  // Copies values to `out` and waits for the GPU. Throws Failure.
  virtual void read(const VertexValues& values, float* out) const = 0;

  // Returns the memory of a model, even if it was not used yet.
  virtual ModelMemory memory_of(const LoadedModel& model) const = 0;

  virtual void release(const Scene& scene) = 0;
};

}  // namespace nook::gl
