// The values that a VOTF is fitted to.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace nook::bake::material {

// Converts binary visibility to signed distances to its boundary (section 6.2). With distances, compression
// keeps silhouettes sharper.

// The distance at which values reach tanh(1), 0.76 of their range, as a share of the texture's longer side.
// Without saturation, the few views that see hardly a gap would set the scale of all others. Views without a
// gap would also stand apart from views with a small one. A smooth saturation has no edge that compression
// would spend ranks on.
inline constexpr float distance_scale = 2.5f / 96;

// Returns the value of a distance in texels, in (-1, 1) and positive where visible. The texture has this
// longer side.
float saturated_distance(float distance_texels, std::uint32_t longer_side);

// masks: view x width x height, visible above 0.5; textures repeat. Returns the same number of values in [-1,
// 1]: the saturated distance from a texel's centre to the boundary, positive where visible, as (26) reads it.
// A mask without a boundary is +1 or -1 throughout.
std::vector<float> signed_distances(std::span<const float> masks, std::uint32_t width, std::uint32_t height);

// Makes targets for the VOTF's fit that only ask on which side of the threshold a value lies.

// The decoder only sees on which side of the threshold a value lies, so that least squares wastes ranks on
// the sizes of values. Returns targets of the next fit. A decoded value on the right side by the margin is
// kept, up to 1.5 times the distance of `values` to the threshold. Every other value must go beyond the
// margin by as much as it fell short of it. A fit to these targets has fewer errors (the squared hinge of N.
// Srebro, J. Rennie, T. Jaakkola: Maximum-margin matrix factorization, 2004). The margin is 0.8 of the
// smallest distance to the threshold in `values`.
std::vector<float> margin_targets(std::span<const float> values, std::span<const float> decoded,
                                  float threshold);

}  // namespace nook::bake::material
