// Appearance vectors: short vectors that describe the surroundings of an exemplar's texels.
#pragma once

#include <cstdint>

#include "bakers/synthesis/exemplar.h"

namespace nook::bake::synthesis {

inline constexpr std::uint32_t appearance_channels = 8;

// The window of a texel is 5 x 5 texels of `values` at the spacing. Returns the leading principal components
// of all windows, a row for each texel.
tensor::Matrix appearance_vectors(const tensor::Matrix& values, const ExemplarShape& shape,
                                  std::int32_t spacing);

}  // namespace nook::bake::synthesis
