#include "sdk/src/gl/character/character_gl.h"

#include "sdk/src/core/failure.h"

namespace nook::gl {

CharacterGl::CharacterGl(Device& device) : device_(device), models_(device.memory), scenes_(device.memory) {
  if (device.gl.tier == 43)
    compute_.emplace(device);
  else
    feedback_.emplace(device);
}

CharacterGl::Entry& CharacterGl::prepared(const SceneHandle& handle) {
  release_destroyed();
  Entry* entry = nullptr;
  for (Entry& known : scenes_)
    if (known.handle.scene == handle.scene) entry = &known;
  if (!entry) entry = &scenes_.emplace_back(device_, handle);
  nook::gl::prepare(device_, models_, entry->buffers, *handle.scene);
  if (compute_) compute_->prepare(models_, entry->buffers);
  return *entry;
}

void CharacterGl::prepare(const SceneHandle& handle) {
  prepared(handle);
}

void CharacterGl::update(const SceneHandle& handle) {
  Entry& entry = prepared(handle);
  if (compute_)
    compute_->update(entry.buffers, *handle.scene);
  else
    feedback_->update(entry.buffers, *handle.scene);
}

AoPlace CharacterGl::ao_place(const Scene& scene, nook_instance_id instance) const {
  const auto slot = static_cast<std::size_t>(&instance_of(scene, instance) - scene.instances.data());
  for (const Entry& entry : scenes_) {
    if (entry.handle.scene != &scene || slot >= entry.buffers.placements.size()) continue;
    const Placement& placement = entry.buffers.placements[slot];
    if (placement.id != instance) continue;
    const std::uint32_t count = placement.chunk->model->file_vertices();
    return {placement.chunk->ao.name(), std::uint64_t{placement.place} * count * sizeof(float), count};
  }
  throw Failure(NOOK_ERROR_INVALID_HANDLE,
                "instance %u has no AO buffer yet; call nook_gl_scene_prepare or nook_gl_scene_update",
                instance);
}

LightPlace CharacterGl::light_place(const Scene& scene, nook_instance_id instance) const {
  const auto slot = static_cast<std::size_t>(&instance_of(scene, instance) - scene.instances.data());
  for (const Entry& entry : scenes_) {
    if (entry.handle.scene != &scene || slot >= entry.buffers.placements.size()) continue;
    const Placement& placement = entry.buffers.placements[slot];
    if (placement.id != instance || placement.first_light_texel == Placement::no_light) continue;
    const std::uint32_t count = placement.chunk->model->file_vertices();
    return {{placement.chunk->directional_ao.name(),
             std::uint64_t{placement.place} * count * 3 * sizeof(float), count},
            entry.buffers.light_texture.name(),
            placement.first_light_texel};
  }
  throw Failure(NOOK_ERROR_INVALID_HANDLE,
                "the last update saw no light of instance %u; call nook_scene_set_light, then "
                "nook_gl_scene_update",
                instance);
}

void CharacterGl::release(const Scene& scene) {
  scenes_.remove_if([&](const Entry& entry) { return entry.handle.scene == &scene; });
  drop_unused(models_);
}

void CharacterGl::release_destroyed() {
  const auto gone = scenes_.remove_if(
      [](const Entry& entry) { return entry.handle.destroyed->load(std::memory_order_acquire); });
  if (gone) drop_unused(models_);
}

}  // namespace nook::gl
