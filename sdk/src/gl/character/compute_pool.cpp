// The part of the compute tier that gives the places of a pool to the instances near the camera.
#include <algorithm>
#include <functional>

#include "sdk/src/character/scene_pool.h"
#include "sdk/src/gl/character/compute_scene.h"

namespace nook::gl {
namespace {

// An instance keeps its place until its distance is this factor times the distance at which it can get one.
// With a factor of 1, an instance near the limit could gain and lose its place in each frame.
constexpr float leaving_share = 1.1f;

}  // namespace

void ComputeScene::make_pool(Device& device) {
  if (!scene->pool.is_used()) return;
  candidates_.reserve(placements.size());
  for (ComputeChunk& chunk : chunks) {
    ComputeModel& model = *chunk.model;
    if (!model.open_ao.name()) model.open_ao = open_buffer(device, "nook: open AO", model.file_vertices());
  }
}

void ComputeScene::measure() noexcept {
  if (!scene->pool.is_used()) return;
  for (std::size_t slot = 0; slot < placements.size(); ++slot) {
    const Instance& instance = scene->instances[slot];
    placements[slot].distance =
        scene->has_camera ? length(instance.input.bound.centre - scene->camera) : 0.0f;
  }
}

bool ComputeScene::may_be_near(std::uint32_t slot, std::uint32_t call) const noexcept {
  const Instance& instance = scene->instances[slot];
  const Placement<ComputeChunk>& placement = placements[slot];
  if (call && placement.pose_call == call) return true;
  if (!was_posed(instance)) return false;
  if (!instance.input.is_posed_on_gpu) return true;
  return placement.chunk && placement.chunk->posed_of[placement.place] == pose_of(instance);
}

void ComputeScene::choose(std::uint32_t call) noexcept {
  candidates_.clear();
  for (std::uint32_t slot = 0; slot < placements.size(); ++slot) {
    Placement<ComputeChunk>& placement = placements[slot];
    placement.is_chosen = false;
    if (!placement.id || !may_be_near(slot, call)) continue;
    const float distance = placement.chunk ? placement.distance / leaving_share : placement.distance;
    if (distance <= scene->pool.distance)
      candidates_.push_back({scene->instances[slot].model.get(), distance, slot});
  }
  const std::uint32_t places = scene->pool.places;
  if (candidates_.size() > places)
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
      if (a.model != b.model) return std::less<>()(a.model, b.model);
      return a.distance != b.distance ? a.distance < b.distance : a.slot < b.slot;
    });
  pool_count = {};
  const LoadedModel* model = nullptr;
  std::uint32_t taken = 0;
  for (const Candidate& candidate : candidates_) {
    // If the candidates are not sorted, models alternate and `taken` restarts too early, but then all
    // candidates fit.
    if (candidate.model != model) taken = 0;
    model = candidate.model;
    if (taken == places) {
      ++pool_count.waiting;
      continue;
    }
    ++taken;
    ++pool_count.near;
    placements[candidate.slot].is_chosen = true;
  }
}

void ComputeScene::leave(Scene& scene_to_change, std::uint32_t slot) noexcept {
  Placement<ComputeChunk>& placement = placements[slot];
  const bool was_seen = !placement.is_new;
  leave_place(placement);
  placement.evaluated = placement.is_new = false;
  if (was_seen) placement.generation = ++scene_to_change.pool.generation;
}

void ComputeScene::enter(Scene& scene_to_change, std::uint32_t slot) noexcept {
  const LoadedModel* const model = scene_to_change.instances[slot].model.get();
  for (ComputeChunk& chunk : chunks) {
    if (chunk.model->model.get() != model || chunk.living == chunk.capacity) continue;
    take_place(chunk, slot);
    placements[slot].evaluated = false;
    placements[slot].is_new = true;
    return;
  }
}

// Takes places away first, so that there is room for the instances that get one.
void ComputeScene::assign(Scene& scene_to_change, std::uint32_t call) noexcept {
  if (!scene->pool.is_used()) return;
  choose(call);
  for (std::uint32_t slot = 0; slot < placements.size(); ++slot) {
    Placement<ComputeChunk>& placement = placements[slot];
    if (!placement.id) continue;
    if (placement.generation == 0) placement.generation = ++scene_to_change.pool.generation;
    if (placement.is_chosen) continue;
    if (placement.chunk) leave(scene_to_change, slot);
    scene_to_change.instances[slot].plan.is_far = true;
    return_parts(scene_to_change, scene_to_change.instances[slot]);
  }
  for (std::uint32_t slot = 0; slot < placements.size(); ++slot) {
    if (!placements[slot].is_chosen) continue;
    if (!placements[slot].chunk) enter(scene_to_change, slot);
    scene_to_change.instances[slot].plan.is_far = false;
    lend_parts(scene_to_change, scene_to_change.instances[slot]);
  }
}

void ComputeScene::finish_assigned(Scene& scene_to_change) noexcept {
  if (!scene->pool.is_used()) return;
  for (Placement<ComputeChunk>& placement : placements) {
    if (!placement.is_new) continue;
    placement.is_new = false;
    placement.generation = ++scene_to_change.pool.generation;
  }
}

void ComputeScene::make_table(Device& device) {
  // The table has an entry for each slot that the scene has reserved, so that it rarely has to grow.
  table.make(device, placements.size(), std::max<std::size_t>(scene->instances.capacity(), 1));
}

void ComputeScene::write_table(const Device& device) noexcept {
  if (!table.is_used()) return;
  table.write(device, placements.size(), [&](std::size_t slot) {
    const Placement<ComputeChunk>& placement = placements[slot];
    if (!placement.id) return PoolEntry{};
    if (!placement.chunk || placement.is_new) return PoolEntry{0, 0, placement.generation, 0};
    return PoolEntry{placement.chunk->ao.name(), placement.place * placement.chunk->model->file_vertices(),
                     placement.generation, scene->instances[slot].plan.level};
  });
}

PooledView ComputeScene::pooled_view(nook_instance_id instance) const {
  const Placement<ComputeChunk>* const placement = find(instance);
  if (!placement) fail_without_place(instance);
  if (placement->chunk && !placement->is_new)
    return {values(placement->chunk->ao, *placement, 1), placement->generation, true};
  const LoadedModel* const model = instance_of(*scene, instance).model.get();
  for (const ComputeChunk& chunk : chunks)
    if (chunk.model->model.get() == model)
      return {
          {chunk.model->open_ao.name(), 0, chunk.model->file_vertices(), 1}, placement->generation, false};
  fail_without_place(instance);
}

}  // namespace nook::gl
