// Computes the values that a VOTF is fitted to.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace nook::bake::material {

// Converts binary visibility to signed distances to its boundary (section 6.2 of the paper). With distances,
// silhouettes stay sharper after compression.

// The distance at which values reach tanh(1), 0.76 of their range, as a share of the texture's longer side.
// Without saturation, the few views that see hardly any gap would have the largest distances, and would
// determine the scale of all other views. There would also be a large difference between views without a gap
// and views with a small gap. The saturation is smooth, because compression would need more ranks for an
// edge.
inline constexpr float distance_scale = 2.5f / 96;

// Converts a distance in texels to a value in (-1, 1), positive where visible. longer_side is the longer side
// of the texture.
float saturated_distance(float distance_texels, std::uint32_t longer_side);

// `masks` is view x width x height, visible above 0.5. Textures repeat. Returns the same number of values in
// [-1, 1]. Each is the saturated distance from a texel's centre to the boundary, positive where visible, as
// equation (26) expects. For a mask without a boundary, all values are +1 or all are -1.
std::vector<float> signed_distances(std::span<const float> masks, std::uint32_t width, std::uint32_t height);

// Makes targets for the VOTF's fit that depend only on whether a value is above or below the threshold.

// The decoder only tests whether a value is above the threshold. Plain least squares wastes ranks on the
// magnitudes of values. Returns the targets for the next fit. A decoded value that is beyond the margin on
// the correct side is kept as the target, up to 1.5 times the distance of `values` to the threshold. For
// every other value, the target exceeds the margin by as much as the decoded value fell short of it. A fit to
// these targets has fewer errors (the squared hinge of N. Srebro, J. Rennie, T. Jaakkola: Maximum-margin
// matrix factorization, 2004). The margin is 0.8 of the smallest distance to the threshold in `values`.
std::vector<float> margin_targets(std::span<const float> values, std::span<const float> decoded,
                                  float threshold);

}  // namespace nook::bake::material
