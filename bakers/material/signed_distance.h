// Binary visibility as signed distances to its boundary (section 6.2), in which compression keeps silhouettes
// sharper.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace nook::bake::material {

// Distances are cut here, as a share of the texture's longer side. Without it the few views that see hardly a
// gap would set the scale of all the others, and views without one would stand apart from views with a small
// one.
inline constexpr float distance_cut = 1.0f / 32;

// masks: view x width x height, visible above 0.5; textures repeat. Returns as many values in [-1, 1]: the
// distance from a texel's centre to the boundary over distance_cut, positive where visible, as (26) reads it.
// A mask without a boundary is +1 or -1 throughout.
std::vector<float> signed_distances(std::span<const float> masks, std::uint32_t width, std::uint32_t height);

}  // namespace nook::bake::material
