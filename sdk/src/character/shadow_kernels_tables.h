// Where each instruction set's translation unit leaves its table. Call one only after asking the processor.
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
