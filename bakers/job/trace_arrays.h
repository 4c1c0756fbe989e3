// Triangles and receivers of a caller for ray tracing, which are checked here. All functions throw
// Failure(INVALID_ARGUMENT).
#pragma once

#include <nook/experimental/nook_trace.h>

#include <cstdint>
#include <vector>

#include "bakers/raytrace/ray_scene.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

// Appends desc.meshes[number], of either kind, to a soup.
void add_mesh(const nook_bake_occluder_mesh& mesh, std::uint32_t number, TriangleSoup& soup);

std::vector<Vec3> read_points(const char* name, const float* xyz, std::uint32_t count);
std::vector<Vec3> read_normals(const char* name, const float* xyz, std::uint32_t count);  // of unit length

void need_trace_settings(std::uint32_t rays, std::uint32_t threads, float origin_offset);

}  // namespace nook::bake
