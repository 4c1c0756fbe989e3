// Chooses the parameters of methods so that their results have the size of a given material file. The size of
// the whole file counts, because users ship whole files. It includes view maps, directions and headers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bakers/material/btf_error.h"
#include "bakers/material/compression.h"

namespace nook::lab {

// Returns the size of the material's file in bytes. If a tensor does not have a view map, adds the size of a
// map with `map_side` cells per side (0: adds nothing). Sizes can thus be compared without computing the
// missing view maps.
std::size_t whole_file_bytes(const nook::material::Material& material, std::uint32_t map_side);

// Returns the size of a material's file without its BTF, in bytes: header, directions, VOTF and recipe.
std::size_t bytes_beside_btf(std::span<const std::byte> file);

// Returns the largest view rank with which the file of an N-SVD has at most `max_bytes`, without a recipe.
// The other ranks come from the settings. Returns 0 if the file is larger even with rank 1.
std::uint32_t n_svd_view_rank(const bake::material::RawMaterial& raw,
                              const bake::material::CompressionSettings& settings, std::size_t max_bytes);

// The result of a fit with principal components of texels (PCA).
struct PcaResult {
  std::size_t components = 0;
  std::size_t bytes = 0;  // components x (3 lights views + texels) half floats
  double se_db = 0, psnr_db = 0;
};

// Finds the best low-rank approximation (Eckart and Young 1936) that fits in `bytes`. The rows of the matrix
// are lights and views, and the columns are texels. The mean is not subtracted, as in the tensor methods.
// Subspace iteration starts from random vectors. The result is rounded to half floats.
PcaResult fit_pca(const bake::material::RawMaterial& raw, std::size_t bytes, std::uint64_t seed);

}  // namespace nook::lab
