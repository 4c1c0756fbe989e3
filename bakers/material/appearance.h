// Represents the appearance of a material's texels as short vectors. The distance between two vectors
// approximates how much the texels differ in radiance over all lights and views, and in visibility over all
// views.
#pragma once

#include <cstdint>

#include "bakers/material/raw_material.h"
#include "bakers/tensor/tensor.h"
#include "sdk/src/material/material.h"

namespace nook::bake::material {

inline constexpr std::uint32_t default_appearance_channels = 12;

// Returns a row for each texel, y * width + x. First adds the many values of a texel, with random signs, into
// 256 sums for radiance and 64 for visibility. This preserves distances to within a few percent (M. Charikar,
// K. Chen, M. Farach-Colton: Finding frequent items in data streams, 2002). The rows are the principal
// components of these sums. Radiance and visibility are scaled to the same total variance. For a material
// without visibility, only radiance is used.
tensor::Matrix appearance_of(const RawMaterial& raw, std::uint64_t seed,
                             std::uint32_t channels = default_appearance_channels);
// Returns the same kind of rows for a compressed material, computed from its modes. Makes the light modes
// orthonormal first.
tensor::Matrix appearance_of(const nook::material::Material& material, std::uint64_t seed,
                             std::uint32_t channels = default_appearance_channels);

}  // namespace nook::bake::material
