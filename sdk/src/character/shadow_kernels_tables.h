// Where each instruction set's translation unit leaves its table. Call one only after asking the processor.
#pragma once

#include "sdk/src/character/shadow_kernels.h"

namespace nook {

// One for all tables: its loads and stores go element by element on every processor, and gather instructions,
// which a compiler would make of the loop for AVX2 and AVX-512, are slower than that on most.
void scatter(const float* values, const std::uint32_t* index, std::uint32_t count, float* out,
             std::size_t stride_bytes);

namespace isa_scalar {
const ShadowKernels& kernels();
}
namespace isa_sse2 {
const ShadowKernels& kernels();
}
namespace isa_avx2 {
const ShadowKernels& kernels();
}
namespace isa_avx512 {
const ShadowKernels& kernels();
}
}  // namespace nook
