// Fits methods at the bytes of whole material files, which users ship: view maps, directions and headers
// count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bakers/material/btf_error.h"
#include "bakers/material/compression.h"

namespace nook::lab {

// Returns the bytes of the material's file. If a tensor has no view map, counts one of map_side cells (0:
// none), so that materials can be compared without resampling them.
std::size_t whole_file_bytes(const nook::material::Material& material, std::uint32_t map_side);

// Returns the bytes of a material's file without its BTF: header, directions, VOTF and recipe.
std::size_t bytes_beside_btf(std::span<const std::byte> file);

// Returns the greatest view rank at which the file of an N-SVD without a recipe takes at most max_bytes, with
// the other ranks of the settings. Returns 0 if rank 1 takes more.
std::uint32_t n_svd_view_rank(const bake::material::RawMaterial& raw,
                              const bake::material::CompressionSettings& settings, std::size_t max_bytes);

// Principal components of texels: the linear method.
struct PcaResult {
  std::size_t components = 0;
  std::size_t bytes = 0;  // components x (3 lights views + texels) half floats
  double se_db = 0, psnr_db = 0;
};

// Finds the best low-rank matrix (Eckart and Young 1936) of light and view against texels that fits in
// `bytes`. It has no mean, like the tensor methods. Subspace iteration starts from random vectors, and the
// result is rounded to half floats.
PcaResult fit_pca(const bake::material::RawMaterial& raw, std::size_t bytes, std::uint64_t seed);

}  // namespace nook::lab
