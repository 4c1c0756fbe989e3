// Reports about the instances of a scene: their memory, and the shapes that the scene evaluates, for debug
// drawing.
#pragma once

#include <nook/experimental/nook_debug.h>

#include <cstdint>

#include "sdk/src/character/loaded_model.h"
#include "sdk/src/character/scene.h"

namespace nook {

// Returns the bytes of an instance without light and links.
std::uint64_t instance_bytes(const LoadedModel& model);
std::uint64_t light_bytes(const LoadedModel& model);

// Returns the number of instances whose pose has a projected bone.
std::uint32_t uneven_instances(const Scene& scene) noexcept;

// These read the shapes that a scene evaluates, one by one in world space, for debug drawing. The kernels of
// an update pose the same shapes in lanes (shadow_kernels.h).

nook_scene_instance_info describe_instance(const Scene& scene, const Instance& instance) noexcept;

// These return the numbers of shapes at the instance's level.
std::uint32_t sphere_count(const Instance& instance) noexcept;
std::uint32_t key_point_count(const Instance& instance) noexcept;
// Returns the number of casters of the instance's last update that are still in the scene.
std::uint32_t link_count(const Scene& scene, const Instance& instance) noexcept;

// `out` must have room for as many shapes as the counts above.
void read_spheres(const Instance& instance, nook_scene_sphere* out) noexcept;
void read_key_points(const Instance& instance, nook_scene_key_point* out) noexcept;
void read_links(const Scene& scene, const Instance& instance, nook_instance_id* out) noexcept;

}  // namespace nook
