// The table of each instruction set's translation unit. A table may only be used on a processor that has the
// instruction set.
#pragma once

#include "sdk/src/probe/fit_kernels.h"

namespace nook {
namespace isa_scalar {
const probe::FitKernels& fit_kernels();
}
namespace isa_sse2 {
const probe::FitKernels& fit_kernels();
}
namespace isa_avx2 {
const probe::FitKernels& fit_kernels();
}
namespace isa_avx512 {
const probe::FitKernels& fit_kernels();
}
}  // namespace nook
