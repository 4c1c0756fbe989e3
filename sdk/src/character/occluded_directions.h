// Provides a model's occluded directions for a host's vertex shader, and computes an instance's bent normals
// for hosts that do not use such a shader.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sdk/src/character/model.h"

namespace nook {

struct Instance;
struct Scene;

inline constexpr std::size_t occluded_bytes = 8, bent_normal_bytes = 4;  // bytes per vertex

// For each file vertex, writes x, y, z and 0 for both members of OccludedEnds. The directions are in the
// space of the file's normals, or in rest space if the model has no bind data. The model must have occluded
// directions.
void copy_occluded_directions(const CharacterModel& model, std::int8_t* out,
                              std::size_t stride_bytes) noexcept;

// Throws Failure(NOOK_ERROR_UNSUPPORTED) unless the model has occluded directions and rest normals.
void check_bent_normals(const CharacterModel& model);

// For each file vertex, writes x, y, z of the bent normal in world space, and the AO. The AO comes from the
// last update, but the normals come from the current pose. The model must pass check_bent_normals.
void read_bent_normals(const Scene& scene, const Instance& instance, std::int8_t* out,
                       std::size_t stride_bytes) noexcept;

}  // namespace nook
