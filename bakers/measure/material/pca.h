// The linear baseline: principal components of texels.
#pragma once

#include <cstdint>

#include "bakers/material/btf_error.h"

namespace nook::bake::material {

struct PcaResult {
  std::size_t components = 0;
  std::size_t bytes = 0;  // components x (3 lights views + texels) half floats
  double se_db = 0, psnr_db = 0;
};

// The best low-rank matrix (Eckart and Young 1936) of light and view against texels that fits in `bytes`,
// without a mean, as the tensor methods have none, by subspace iteration from a random start; rounded to half
// floats.
PcaResult fit_pca(const RawMaterial& raw, std::size_t bytes, std::uint64_t seed);

}  // namespace nook::bake::material
