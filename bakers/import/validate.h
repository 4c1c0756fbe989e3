// The check of a mesh before a bake, for meshes from files and from memory.
#pragma once

#include <nook/nook.h>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

struct FileMesh;

constexpr std::size_t max_bone_count = 65535;  // bone indices are 16 bits
constexpr std::size_t max_file_vertices =
    10'000'000;  // bounds memory on hostile input, far above any character

// Bones: 1 to max_bone_count, parents before children, finite orthonormal frames. Positions finite, weights
// finite, non-negative, sum 1 and not all zero, bones and indices in range, primitives in a row over all
// vertices, at least one triangle. Fails with `code`, naming the first fault and how many there are.
void validate(const FileMesh& mesh, nook_result code = NOOK_ERROR_INVALID_ARGUMENT);
void validate(const SkinnedMesh& mesh, nook_result code = NOOK_ERROR_INVALID_ARGUMENT);

}  // namespace nook::bake
