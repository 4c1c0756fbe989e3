// The interface of a tier, which evaluates characters on one kind of OpenGL. A tier owns the buffers of every
// scene that it evaluates and of the models of these scenes. It depends on abilities of the context
// (functions.h), so that another kind, such as OpenGL ES or WebGL 2, is another implementation.
#pragma once

#include "sdk/src/character/scene.h"
#include "sdk/src/gl/device.h"

namespace nook::gl {

// Values of an instance's vertices in a buffer.
struct VertexValues {
  GLuint buffer = 0;
  std::uint64_t offset = 0;    // bytes
  std::uint32_t vertices = 0;  // in the model's file
  std::uint32_t channels = 1;  // floats of a vertex

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

// Every call but the const ones may change any of the touched state; the caller holds a StateGuard.
class Tier {
 public:
  Tier() = default;
  Tier(const Tier&) = delete;
  Tier& operator=(const Tier&) = delete;
  virtual ~Tier() = default;

  // Gives every instance of the scene a place, and makes all buffers and programs that its update needs;
  // costs little where nothing has changed. Throws Failure; what was made until then stays, and the next call
  // goes on.
  virtual void prepare(const Scene& scene) = 0;
  // Evaluates a scene that is prepared. Throws Failure; the next update makes up for this one.
  virtual void update(Scene& scene) = 0;

  // Throws Failure unless the instance has a place.
  virtual VertexValues place(const Scene& scene, nook_instance_id instance) const = 0;
  // Throws Failure unless the last update saw a light of the instance.
  virtual LightPlace light_place(const Scene& scene, nook_instance_id instance) const = 0;

  // Copies values to `out`, waiting for the GPU. Throws Failure.
  virtual void read(const VertexValues& values, float* out) const = 0;

  // Of a model that need not have been used yet.
  virtual ModelMemory memory_of(const LoadedModel& model) const = 0;

  // Drops everything of the scene.
  virtual void release(const Scene& scene) = 0;
};

}  // namespace nook::gl
