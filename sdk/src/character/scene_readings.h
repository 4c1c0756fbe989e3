// Reads the memory use of a scene's instances, and for debug drawing, the shapes that the scene evaluates.
#pragma once

#include <nook/experimental/nook_debug.h>

#include <cstdint>

#include "sdk/src/character/loaded_model.h"
#include "sdk/src/character/scene.h"

namespace nook {

// Returns the memory of an instance in bytes, without its light and its links.
std::uint64_t instance_bytes(const LoadedModel& model);
std::uint64_t light_bytes(const LoadedModel& model);

// Returns the number of instances that have a projected bone in their pose.
std::uint32_t uneven_instances(const Scene& scene) noexcept;

// The functions below read the shapes that a scene evaluates, for debug drawing. These functions transform
// the shapes to world space one by one. An update transforms the same shapes with SIMD kernels
// (shadow_kernels.h).

nook_scene_instance_info describe_instance(const Scene& scene, const Instance& instance) noexcept;

// sphere_count and key_point_count return the number of shapes at the instance's level.
std::uint32_t sphere_count(const Instance& instance) noexcept;
std::uint32_t key_point_count(const Instance& instance) noexcept;
// Returns how many casters of the instance's last update are still in the scene.
std::uint32_t link_count(const Scene& scene, const Instance& instance) noexcept;

// `out` must have room for the number of elements that the functions above return.
void read_spheres(const Instance& instance, nook_scene_sphere* out) noexcept;
void read_key_points(const Instance& instance, nook_scene_key_point* out) noexcept;
void read_links(const Scene& scene, const Instance& instance, nook_instance_id* out) noexcept;

}  // namespace nook
