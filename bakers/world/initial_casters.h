// Makes capsules that fill a body. They are the initial state of a fit, and also serve as a baseline.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Refines a mesh. This is needed because capsules are made from vertices, and furniture has few vertices.

// Returns the same surface with edges of at most 1/40 of the diagonal of its bounding box. The result has
// only positions, weights and triangles.
SkinnedMesh refined(const SkinnedMesh& mesh);

// Makes one capsule for each bone that has the largest weight at some vertices. The axis is the first
// principal axis of these vertices, weighted by area. The radius is their mean distance from the axis. The
// caps end where the vertices end.
std::vector<WorldCaster> bone_capsules(const SkinnedMesh& mesh, std::span<const float> vertex_area);

// Makes exactly `count` capsules, or as many as the vertices allow. Bones with little area are merged with
// their parents. If there are still too many bones, those with the least area are merged too. If there are
// too few capsules, the one with the largest misfit is cut in two across its longest axis, as often as
// needed.
std::vector<WorldCaster> initial_casters(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                         std::size_t count);

}  // namespace nook::bake
