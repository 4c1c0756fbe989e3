// The kernels for AVX-512.
#include "sdk/src/core/simd_avx512.h"

#include <nook/nook_probe.h>

#include "sdk/src/probe/fit_kernels.h"
#include "sdk/src/probe/fit_kernels_tables.h"

namespace nook::isa_avx512 {

#include "sdk/src/probe/fit_kernels_impl.inl"

constexpr probe::FitKernels fit_table{Isa::avx512, "avx512",      gaussian_values, step_fast,
                                      step_plain,  step_original, sum_moments,     sum_gram};

const probe::FitKernels& fit_kernels() {
  return fit_table;
}

}  // namespace nook::isa_avx512
