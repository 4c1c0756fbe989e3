// Makes capsules that fill a body. A fit starts from them, and comparisons use them as a baseline.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Refines a mesh. Capsules are made from vertices, and furniture has too few of them.

// Returns the same surface with edges of at most 1/40 of the diagonal of its bounding box. The result has
// only positions, weights and triangles.
SkinnedMesh refined(const SkinnedMesh& mesh);

// Makes one capsule for each bone that has the largest weight at some vertices. The capsule's axis is the
// first principal axis of these vertices, weighted by area. Its radius is their mean distance from the axis.
// Its caps end where the vertices end.
std::vector<WorldCaster> bone_capsules(const SkinnedMesh& mesh, std::span<const float> vertex_area);

// Makes exactly `count` capsules, or as many as the vertices allow. First merges bones with little area with
// their parents. If there are still too many bones, merges the bones with the least area too. If there are
// too few capsules, repeatedly cuts the capsule with the largest misfit in two, across its longest axis.
std::vector<WorldCaster> initial_casters(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                         std::size_t count);

}  // namespace nook::bake
