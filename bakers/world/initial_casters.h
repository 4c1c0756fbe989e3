// Capsules that fill a body: where a fit begins, and a baseline of their own.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// A mesh of small triangles: capsules begin from vertices, and furniture has few.

// The same surface, of triangles whose edges are at most a fortieth of the diagonal of its box long. Only
// positions, weights and triangles are there.
SkinnedMesh refined(const SkinnedMesh& mesh);

// One capsule for each bone with vertices of its own: those whose strongest bone it is, weighted by area. Its
// axis is the first principal axis, its radius the mean distance from it, its length such that its caps end
// where the vertices do.
std::vector<WorldCaster> bone_capsules(const SkinnedMesh& mesh, std::span<const float> vertex_area);

// Exactly `count` capsules, or as many as the vertices allow: bones with little area join their parents until
// they fit, then the capsule with the largest misfit is cut in two across its longest axis, as often as it
// takes.
std::vector<WorldCaster> initial_casters(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                         std::size_t count);

}  // namespace nook::bake
