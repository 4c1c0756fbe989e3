#include "sdk/src/character/scene_pool.h"

#include <algorithm>

#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"

namespace nook {
namespace {

bool are_lent(const InstanceParts& parts) {
  return parts.bones.empty();
}

}  // namespace

const InstanceParts& Instance::read_parts() const {
  static const InstanceParts none(default_memory());
  return parts ? *parts : none;
}

void set_pool(Scene& scene, std::uint32_t places, float distance, std::uint32_t instances) {
  if (scene.living > 0 && places != scene.pool.places)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the scene has %u instances, so only the distance of its pool may change (got %u places, "
                  "the pool has %u); set the pool before you add instances",
                  scene.living, places, scene.pool.places);
  scene.instances.reserve(instances);
  scene.pool.places = places;
  scene.pool.distance = distance;
  if (scene.living > 0) return;
  scene.has_arrays = false;
  scene.was_updated_on_cpu = false;
  ++scene.structure_revision;
}

void need_no_pool(const Scene& scene, const char* reason) {
  if (scene.pool.is_used())
    throw Failure(NOOK_ERROR_UNSUPPORTED, "the scene has a pool (nook_gl_scene_set_pool), but %s", reason);
}

Vector<PoolShare> pool_shares(const Scene& scene, Memory* memory) {
  Vector<PoolShare> shares(memory);
  std::size_t last = 0;
  for (const Instance& instance : scene.instances) {
    if (instance.id == 0) continue;
    if (last >= shares.size() || shares[last].model.get() != instance.model.get()) {
      last = 0;
      while (last < shares.size() && shares[last].model.get() != instance.model.get()) ++last;
      if (last == shares.size()) shares.push_back({instance.model, 0, 0});
    }
    ++shares[last].living;
  }
  for (PoolShare& share : shares) share.places = std::min(share.living, scene.pool.places);
  return shares;
}

// The pool never frees its parts, so that no update has to make them again.
void reserve_parts(Scene& scene) {
  ScenePool& pool = scene.pool;
  if (!pool.is_used() || pool.reserved_revision == scene.structure_revision) return;
  std::uint32_t wanted = 0;
  std::size_t casters = 0;
  for (const PoolShare& share : pool_shares(scene, scene.memory)) {
    wanted += share.places;
    casters = std::max(casters, share.model->model.world_casters.size());
  }
  pool.spare.reserve(std::max(wanted, pool.made));
  for (; pool.made < wanted; ++pool.made)
    pool.spare.push_back(Box<InstanceParts>::make(scene.memory, scene.memory));
  for (Box<InstanceParts>& parts : pool.spare) parts->casters.posed.reserve(casters);
  for (Instance& instance : scene.instances)
    if (instance.parts && are_lent(*instance.parts)) instance.parts->casters.posed.reserve(casters);
  pool.reserved_revision = scene.structure_revision;
}

void lend_parts(Scene& scene, Instance& instance) noexcept {
  ScenePool& pool = scene.pool;
  if (instance.parts || pool.spare.empty()) return;
  instance.parts = std::move(pool.spare.back());
  pool.spare.pop_back();
  instance.parts->casters.posed.resize(instance.model->model.world_casters.size());
  instance.parts->casters.posed_revision = 0;
}

void return_parts(Scene& scene, Instance& instance) noexcept {
  if (!instance.parts || !are_lent(*instance.parts)) return;
  scene.pool.spare.push_back(std::move(instance.parts));
  instance.parts = {};
}

void need_own_parts(Scene& scene, Instance& instance) {
  if (instance.parts && !are_lent(*instance.parts)) return;
  const LoadedModel& model = *instance.model;
  auto own = Box<InstanceParts>::make(scene.memory, scene.memory);
  own->bones.resize(model.model.bone_count());
  own->uneven.resize(model.model.bone_count());
  own->casters.posed.resize(model.model.world_casters.size());
  return_parts(scene, instance);
  instance.parts = std::move(own);
}

}  // namespace nook
