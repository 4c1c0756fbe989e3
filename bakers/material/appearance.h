// The looks of a material's texels as short vectors, whose distances are those of the texels' radiances over
// all lights and views and of their visibilities over all views.
#pragma once

#include <cstdint>

#include "bakers/material/raw_material.h"
#include "bakers/tensor/tensor.h"
#include "sdk/src/material/material.h"

namespace nook::bake::material {

inline constexpr std::uint32_t default_appearance_channels = 12;

// Returns a row for each texel, y * width + x. The many values of a texel are first added, with random signs,
// into 256 sums for radiance and 64 for visibility, which keeps distances to some percent (M. Charikar, K.
// Chen, M. Farach-Colton: Finding frequent items in data streams, 2002); then principal components are
// taken. Radiance and visibility have the same total variance; a material without visibility has radiance
// alone.
tensor::Matrix appearance_of(const RawMaterial& raw, std::uint64_t seed,
                             std::uint32_t channels = default_appearance_channels);
// The same from the reduced modes of a compressed material, whose light modes are made orthonormal.
tensor::Matrix appearance_of(const nook::material::Material& material, std::uint64_t seed,
                             std::uint32_t channels = default_appearance_channels);

}  // namespace nook::bake::material
