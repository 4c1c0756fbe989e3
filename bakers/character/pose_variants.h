// New poses made of given ones: mirrored, with limbs of one on the body of another, and between and beyond
// two.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// count poses; the same seed gives the same poses. Empty where no pose is given.
std::vector<Pose> pose_variants(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                std::span<const Pose> poses, std::size_t count, std::uint64_t seed);

}  // namespace nook::bake
