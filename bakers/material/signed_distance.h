// Binary visibility as signed distances to its boundary (section 6.2), in which compression keeps silhouettes
// sharper.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace nook::bake::material {

// The distance at which values have risen to tanh(1), 0.76 of their range, as a share of the texture's longer
// side. Without saturation the few views that see hardly a gap would set the scale of all the others, and
// views without one would stand apart from views with a small one. A smooth one has no edge that compression
// would spend ranks on.
inline constexpr float distance_scale = 2.5f / 96;

// The value of a distance in texels of a texture with that longer side, in (-1, 1); positive where visible.
float saturated_distance(float distance_texels, std::uint32_t longer_side);

// masks: view x width x height, visible above 0.5; textures repeat. Returns as many values in [-1, 1]: the
// saturated distance from a texel's centre to the boundary, positive where visible, as (26) reads it.
// A mask without a boundary is +1 or -1 throughout.
std::vector<float> signed_distances(std::span<const float> masks, std::uint32_t width, std::uint32_t height);

}  // namespace nook::bake::material
