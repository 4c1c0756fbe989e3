// Methods at the bytes of whole material files, which users ship: view maps, directions and headers count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bakers/material/btf_error.h"
#include "bakers/material/compression.h"

namespace nook::lab {

// The bytes of the material's file. Where a tensor has no view map, one of map_side cells is counted for it,
// 0 cells being none, so that materials can be compared without resampling them.
std::size_t whole_file_bytes(const nook::material::Material& material, std::uint32_t map_side);

// The bytes of what a material's file holds beside its BTF: header, directions, VOTF and recipe.
std::size_t bytes_beside_btf(std::span<const std::byte> file);

// The greatest view rank at which the file of an N-SVD without a recipe, with the other ranks of the
// settings, takes at most max_bytes; 0 where rank 1 takes more.
std::uint32_t n_svd_view_rank(const bake::material::RawMaterial& raw,
                              const bake::material::CompressionSettings& settings, std::size_t max_bytes);

// Principal components of texels, the linear method.
struct PcaResult {
  std::size_t components = 0;
  std::size_t bytes = 0;  // components x (3 lights views + texels) half floats
  double se_db = 0, psnr_db = 0;
};

// The best low-rank matrix (Eckart and Young 1936) of light and view against texels that fits in `bytes`,
// without a mean, as the tensor methods have none, by subspace iteration from a random start; rounded to half
// floats.
PcaResult fit_pca(const bake::material::RawMaterial& raw, std::size_t bytes, std::uint64_t seed);

}  // namespace nook::lab
