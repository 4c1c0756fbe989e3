// A pool for crowds on the GPU. An instance near the camera gets a place in the pool: parts on the CPU
// (InstanceParts) and arrays on the GPU. All other instances are in the far form: Nook stores only their
// settings and pose and does not compute their AO, and they darken no other instance.
// sdk/src/gl/character/compute_pool.cpp chooses the near instances.
#pragma once

#include <cstdint>

#include "sdk/src/character/scene.h"

namespace nook {

// Gives a scene a pool, which then replaces the arrays of all instances. Reserves memory for `instances`.
// Throws Failure unless the scene is empty. If only the distance changes, the scene need not be empty.
void set_pool(Scene& scene, std::uint32_t places, float distance, std::uint32_t instances);

// Throws Failure(NOOK_ERROR_UNSUPPORTED) if the scene has a pool. `reason` is the end of the message.
void need_no_pool(const Scene& scene, const char* reason);

// The places that the instances of a model share.
struct PoolShare {
  Ref<const LoadedModel> model;
  std::uint32_t living = 0, places = 0;
};
// Returns the share of each model. Throws std::bad_alloc.
Vector<PoolShare> pool_shares(const Scene& scene, Memory* memory);

// Makes the parts that the pool lends, if instances were added since the last call. Throws std::bad_alloc.
void reserve_parts(Scene& scene);
// Lends parts of the pool to an instance that has none. Does not allocate.
void lend_parts(Scene& scene, Instance& instance) noexcept;
// Takes back the parts that the pool lent to an instance. Parts with bones stay, because the host poses this
// instance on the CPU.
void return_parts(Scene& scene, Instance& instance) noexcept;
// Gives an instance parts with bones, so that the CPU can pose it. Throws std::bad_alloc.
void need_own_parts(Scene& scene, Instance& instance);

// Returns whether the host has posed the instance. An instance of a pool waits in the far form for its first
// pose.
inline bool was_posed(const Instance& instance) {
  return instance.input.pose_revision > 1;
}

}  // namespace nook
