// The kernels for SSE2.
#include "sdk/src/core/simd_sse2.h"

#include <nook/nook_probe.h>

#include "sdk/src/probe/fit_kernels.h"
#include "sdk/src/probe/fit_kernels_tables.h"

namespace nook::isa_sse2 {

#include "sdk/src/probe/fit_kernels_impl.inl"

constexpr probe::FitKernels fit_table{Isa::sse2,  "sse2",        gaussian_values, step_fast,
                                      step_plain, step_original, sum_moments,     sum_gram};

const probe::FitKernels& fit_kernels() {
  return fit_table;
}

}  // namespace nook::isa_sse2
