// Where each instruction set's translation unit leaves its table. Call one only after asking the processor.
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
