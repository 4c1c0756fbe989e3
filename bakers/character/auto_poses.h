// Plausible whole-body poses without any clip: ranges and couplings of the human body for the joints whose
// role is known, heavy-tailed small turns for all others, and rejection of poses in which the body runs
// through itself.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// count poses; the same seed gives the same poses. Rest space of glTF: +y is up.
std::vector<Pose> auto_poses(const SkinnedMesh& mesh, std::span<const float> vertex_area, std::size_t count,
                             std::uint64_t seed);

}  // namespace nook::bake
