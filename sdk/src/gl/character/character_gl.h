// Characters on the GPU: everything that one nook_gl holds for the scenes it evaluates.
#pragma once

#include <atomic>
#include <list>
#include <optional>

#include "sdk/src/gl/character/compute_tier.h"
#include "sdk/src/gl/character/feedback_tier.h"

namespace nook::gl {

// A scene as its owner hands it in; `owner` keeps the memory of the others, `destroyed` says that the host
// let go of it.
struct SceneHandle {
  Ref<const RefCounted> owner;
  const std::atomic<bool>* destroyed = nullptr;
  Scene* scene = nullptr;
};

struct AoPlace {
  GLuint buffer = 0;
  std::uint64_t offset = 0;  // bytes
  std::uint32_t count = 0;   // floats
};

struct LightPlace {
  AoPlace directional_ao;  // count: vertices, three floats each
  GLuint texture = 0;      // of the lights
  std::uint32_t first_texel = 0;
};

// Every call may change any of the touched state; the caller holds a StateGuard where OpenGL is called.
class CharacterGl {
 public:
  // Throws Failure.
  explicit CharacterGl(Device& device);

  void prepare(const SceneHandle& handle);
  void update(const SceneHandle& handle);
  // Throws Failure unless the instance has a place.
  AoPlace ao_place(const Scene& scene, nook_instance_id instance) const;
  // Throws Failure unless the last update saw a light of the instance.
  LightPlace light_place(const Scene& scene, nook_instance_id instance) const;
  void release(const Scene& scene);
  // Of scenes that the host destroyed.
  void release_destroyed();

 private:
  struct Entry {
    Entry(Device& device, const SceneHandle& of) : handle(of), buffers(device, device.memory) {}
    SceneHandle handle;
    SceneBuffers buffers;
  };
  Entry& prepared(const SceneHandle& handle);

  Device& device_;
  std::optional<ComputeTier> compute_;
  std::optional<FeedbackTier> feedback_;
  ModelList models_;
  std::pmr::list<Entry> scenes_;  // destroyed before the models that their chunks use
};

}  // namespace nook::gl
