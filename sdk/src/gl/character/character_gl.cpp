#include "sdk/src/gl/character/character_gl.h"

#include <algorithm>

#include "sdk/src/character/scene_pool.h"

namespace nook::gl {

CharacterGl::CharacterGl(Device& device) : scenes_(device.memory), output_(device) {
  if (device.gl.can.compute)
    tier_ = &storage_.emplace<ComputeTier>(device);
  else
    tier_ = &storage_.emplace<FeedbackTier>(device);
}

// Makes or releases what the tier needs on the CPU, and calls `prepare_on_gpu` in between.
template <class PrepareOnGpu>
void CharacterGl::prepare_by(const SceneHandle& handle, const PrepareOnGpu& prepare_on_gpu) {
  release_destroyed();
  const auto known = [&](const SceneHandle& of) { return of.scene == handle.scene; };
  if (std::none_of(scenes_.begin(), scenes_.end(), known)) scenes_.push_back(handle);
  const bool computes = std::holds_alternative<ComputeTier>(storage_);
  // The other tier updates key points on the CPU.
  if (!computes) {
    need_no_pool(*handle.scene, "this OpenGL has no compute shaders; use a scene without a pool");
    make_arrays(*handle.scene);
  }
  reserve_parts(*handle.scene);
  prepare_on_gpu();
  // The arrays are released only after the preparation has succeeded. If it fails, the host can still update
  // on the CPU without an allocation.
  if (computes && handle.scene->has_arrays) leave_arrays(*handle.scene);
}

void CharacterGl::prepare(const SceneHandle& handle) {
  prepare_by(handle, [&] { tier_->prepare(*handle.scene); });
}

void CharacterGl::prepare_unless_streaming(const SceneHandle& handle) {
  prepare_by(handle, [&] {
    if (!tier_->is_streaming(*handle.scene)) tier_->prepare(*handle.scene);
  });
}

void CharacterGl::set_streaming(const SceneHandle& handle, std::uint32_t fade_updates) {
  prepare_by(handle, [&] { tier_->set_streaming(*handle.scene, fade_updates); });
}

StreamLeft CharacterGl::prepare_within(const SceneHandle& handle, const Budget& budget) {
  StreamLeft left;
  prepare_by(handle, [&] { left = tier_->prepare_within(*handle.scene, budget); });
  return left;
}

void CharacterGl::update(const SceneHandle& handle) {
  prepare_unless_streaming(handle);
  tier_->update(*handle.scene);
}

void CharacterGl::set_poses(const SceneHandle& handle, const PoseBatch& batch) {
  prepare_unless_streaming(handle);
  tier_->set_poses(*handle.scene, batch);
}

void CharacterGl::read_pose(const Scene& scene, nook_instance_id instance, std::span<Mat3x4> bones) const {
  tier_->read_pose(scene, instance, bones);
}

VertexValues CharacterGl::place(const Scene& scene, nook_instance_id instance) const {
  return tier_->place(scene, instance);
}

LightPlace CharacterGl::light_place(const Scene& scene, nook_instance_id instance) const {
  return tier_->light_place(scene, instance);
}

void CharacterGl::read(const VertexValues& values, float* out) const {
  tier_->read(values, out);
}

void CharacterGl::release(const Scene& scene) {
  tier_->release(scene);
  scenes_.remove_if([&](const SceneHandle& handle) { return handle.scene == &scene; });
}

void CharacterGl::release_destroyed() {
  scenes_.remove_if([&](const SceneHandle& handle) {
    const bool gone = handle.destroyed->load(std::memory_order_acquire);
    if (gone) tier_->release(*handle.scene);
    return gone;
  });
}

}  // namespace nook::gl
