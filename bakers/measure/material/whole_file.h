// The bytes of whole material files, which users ship: view maps, directions and headers count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bakers/material/compression.h"

namespace nook::bake::material {

// Of the material's file. Where a tensor has no view map, one of map_side cells is counted for it, 0 cells
// being none, so that materials can be compared without resampling them.
std::size_t whole_file_bytes(const nook::material::Material& material, std::uint32_t map_side);

// Of what a material's file holds beside its BTF: header, directions, VOTF and recipe.
std::size_t bytes_beside_btf(std::span<const std::byte> file);

// The greatest view rank at which the file of an N-SVD without a recipe, with the other ranks of the
// settings, takes at most max_bytes; 0 where rank 1 takes more.
std::uint32_t n_svd_view_rank(const RawMaterial& raw, const CompressionSettings& settings,
                              std::size_t max_bytes);

}  // namespace nook::bake::material
