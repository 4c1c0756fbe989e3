// Fits methods to the size of whole material files, because users ship whole files. View maps, directions and
// headers are therefore counted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bakers/material/btf_error.h"
#include "bakers/material/compression.h"

namespace nook::lab {

// Returns the size of the material's file in bytes. If a tensor does not have a view map, adds the size of a
// map with `map_side` cells per side (0: adds nothing). Materials can thus be compared without resampling.
std::size_t whole_file_bytes(const nook::material::Material& material, std::uint32_t map_side);

// Returns the size of a material's file without its BTF, in bytes: header, directions, VOTF and recipe.
std::size_t bytes_beside_btf(std::span<const std::byte> file);

// Returns the largest view rank at which the file of an N-SVD without a recipe has at most `max_bytes`. The
// other ranks are from the settings. Returns 0 if even rank 1 needs more bytes.
std::uint32_t n_svd_view_rank(const bake::material::RawMaterial& raw,
                              const bake::material::CompressionSettings& settings, std::size_t max_bytes);

// A fit by principal components of texels, the linear method.
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
