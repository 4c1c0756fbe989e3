// The plain arrays of the C interface: poses, meshes, and triangles for rays.
#pragma once

#include <nook/experimental/nook_trace.h>
#include <nook/nook_bake.h>

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/gltf.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ray_scene.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

// Throws INVALID_ARGUMENT if a value is not finite or exceeds the limit for poses. The message names the pose
// and the bone.
std::vector<Pose> read_poses(const float* bones_3x4, std::size_t poses, std::size_t bones);
void write_pose(const Pose& pose, float* bones_3x4);
void write_points(std::span<const Vec3> welded, std::span<const std::uint32_t> file_to_welded, float* xyz);

// Throws INVALID_ARGUMENT if `got` differs from `needed`.
void need_count(const char* name, std::size_t got, std::size_t needed);

// Makes a character from arrays that the host passes.

// If there are errors, throws INVALID_ARGUMENT with the first one.
ImportedCharacter character_of_arrays(const nook_bake_source_desc& desc);

// These functions read and check a caller's triangles and receivers for ray tracing. All of them throw
// Failure(INVALID_ARGUMENT).

// Checks a mesh and appends it to a soup. `number` is the index of the mesh in desc.meshes, for messages.
void add_mesh(const nook_bake_occluder_mesh& mesh, std::uint32_t number, TriangleSoup& soup);

std::vector<Vec3> read_points(const char* name, const float* xyz, std::uint32_t count);
std::vector<Vec3> read_normals(const char* name, const float* xyz,
                               std::uint32_t count);  // unit length

void need_trace_settings(std::uint32_t rays, std::uint32_t threads, float origin_offset);

}  // namespace nook::bake
