// The table of each instruction set's translation unit. A table may only be used on a processor that has the
// instruction set.
#pragma once

#include "sdk/src/character/shadow_kernels.h"

namespace nook {

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
