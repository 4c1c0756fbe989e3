// Poses and points as the plain float arrays of the C interface.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// Throws INVALID_ARGUMENT, which names the pose and the bone, if a number is not finite or beyond the bound
// of a pose.
std::vector<Pose> read_poses(const float* bones_3x4, std::size_t poses, std::size_t bones);
void write_pose(const Pose& pose, float* bones_3x4);
void write_points(std::span<const Vec3> welded, std::span<const std::uint32_t> file_to_welded, float* xyz);

// Throws INVALID_ARGUMENT unless the caller's count is the required one.
void need_count(const char* name, std::size_t got, std::size_t needed);

}  // namespace nook::bake
