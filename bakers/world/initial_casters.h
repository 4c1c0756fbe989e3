// Capsules that fill a body. They start a fit and are a baseline of their own.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// Refines a mesh, because capsules start from vertices, and furniture has few.

// Returns the same surface with edges of at most a fortieth of its box's diagonal. It has only positions,
// weights and triangles.
SkinnedMesh refined(const SkinnedMesh& mesh);

// Makes one capsule for each bone that is the strongest bone of some vertices, weighted by area. Its axis is
// the first principal axis of these vertices, and its radius is their mean distance from the axis. Its caps
// end where the vertices do.
std::vector<WorldCaster> bone_capsules(const SkinnedMesh& mesh, std::span<const float> vertex_area);

// Makes exactly `count` capsules, or as many as the vertices allow. Bones with little area join their parents
// until they fit. Then the capsule with the largest misfit is cut in two across its longest axis, as often as
// needed.
std::vector<WorldCaster> initial_casters(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                         std::size_t count);

}  // namespace nook::bake
