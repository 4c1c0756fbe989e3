// Characters on the GPU: everything that one nook_gl holds for its scenes.
#pragma once

#include <atomic>
#include <list>
#include <variant>

#include "sdk/src/gl/character/ao_output.h"
#include "sdk/src/gl/character/compute_tier.h"
#include "sdk/src/gl/character/feedback_tier.h"

namespace nook::gl {

// A scene and its owner. `owner` keeps the memory of the other members alive, and `destroyed` is true once
// the host has destroyed the scene.
struct SceneHandle {
  Ref<const RefCounted> owner;
  const std::atomic<bool>* destroyed = nullptr;
  Scene* scene = nullptr;
};

// The best tier of the device, and the scenes that it evaluates. tier.h documents which functions may change
// OpenGL state.
class CharacterGl {
 public:
  // Throws Failure.
  explicit CharacterGl(Device& device);
  CharacterGl(const CharacterGl&) = delete;
  CharacterGl& operator=(const CharacterGl&) = delete;

  void prepare(const SceneHandle& handle);
  void update(const SceneHandle& handle);
  void set_streaming(const SceneHandle& handle, std::uint32_t fade_updates);
  bool is_streaming(const Scene& scene) const { return tier_->is_streaming(scene); }
  StreamLeft prepare_within(const SceneHandle& handle, const Budget& budget);
  void set_poses(const SceneHandle& handle, const PoseBatch& batch);
  void read_pose(const Scene& scene, nook_instance_id instance, std::span<Mat3x4> bones) const;
  VertexValues place(const Scene& scene, nook_instance_id instance) const;
  PooledView pooled_view(const Scene& scene, nook_instance_id instance) const {
    return tier_->pooled_view(scene, instance);
  }
  PoolCount pool_count(const Scene& scene) const { return tier_->pool_count(scene); }
  PoolTablePlace pool_table(const SceneHandle& handle, const LoadedModel& model,
                            std::span<GLuint> ao_buffers) {
    prepare(handle);
    return tier_->pool_table(*handle.scene, model, ao_buffers);
  }
  LightPlace light_place(const Scene& scene, nook_instance_id instance) const;
  void read(const VertexValues& values, float* out) const;
  // Copies AO to the host's own buffers and textures. The caller must hold a StateGuard for output_users.
  AoOutput& output() { return output_; }
  ModelMemory memory_of(const LoadedModel& model) const { return tier_->memory_of(model); }
  void release(const Scene& scene);
  // Releases scenes that the host destroyed.
  void release_destroyed();

 private:
  template <class PrepareOnGpu>
  void prepare_by(const SceneHandle& handle, const PrepareOnGpu& prepare_on_gpu);
  void prepare_unless_streaming(const SceneHandle& handle);

  List<SceneHandle> scenes_;
  std::variant<std::monostate, FeedbackTier, ComputeTier> storage_;
  Tier* tier_;  // points into storage_
  AoOutput output_;
};

}  // namespace nook::gl
