// Binary visibility as signed distances to its boundary (section 6.2), in which compression keeps silhouettes
// sharper.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace nook::bake::material {

// masks: view x width x height, visible above 0.5; textures repeat. Returns as many values in [-1, 1]: the
// distance from a texel's centre to the boundary, positive where visible, as (26) reads it. texel_distance
// receives the distance in texels that 1 stands for: the largest of all masks. A mask without a boundary is
// +1 or -1 throughout.
std::vector<float> signed_distances(std::span<const float> masks, std::uint32_t width, std::uint32_t height,
                                    float& texel_distance);

}  // namespace nook::bake::material
