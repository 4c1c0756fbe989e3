// The looks of a material's texels as short vectors. Distances between vectors are close to the distances
// between radiances over all lights and views, and between visibilities over all views.
#pragma once

#include <cstdint>

#include "bakers/material/raw_material.h"
#include "bakers/tensor/tensor.h"
#include "sdk/src/material/material.h"

namespace nook::bake::material {

inline constexpr std::uint32_t default_appearance_channels = 12;

// Returns a row for each texel, y * width + x. The many values of a texel are first added, with random signs,
// into 256 sums for radiance and 64 for visibility, which keeps distances to some percent (M. Charikar, K.
// Chen, M. Farach-Colton: Finding frequent items in data streams, 2002). The rows are the principal
// components of these sums. Radiance and visibility have the same total variance; a material without
// visibility has radiance alone.
tensor::Matrix appearance_of(const RawMaterial& raw, std::uint64_t seed,
                             std::uint32_t channels = default_appearance_channels);
// The same from the reduced modes of a compressed material. Makes its light modes orthonormal first.
tensor::Matrix appearance_of(const nook::material::Material& material, std::uint64_t seed,
                             std::uint32_t channels = default_appearance_channels);

}  // namespace nook::bake::material
