// The reference: plain float arithmetic, and what processors without x86 SIMD run.
#include <nook/nook_probe.h>

#include <cstdint>

#include "sdk/src/core/simd_scalar.h"
#include "sdk/src/probe/fit_kernels.h"
#include "sdk/src/probe/fit_kernels_tables.h"

namespace nook::isa_scalar {

using Float = float;
constexpr std::uint32_t width = 1;

namespace {
Float broadcast(float a) {
  return a;
}
Float load(const float* p) {
  return *p;
}
void store(float* p, Float a) {
  *p = a;
}
}  // namespace

#include "sdk/src/probe/fit_kernels_impl.inl"

constexpr probe::FitKernels fit_table{Isa::scalar, "scalar",      gaussian_values, step_fast,
                                      step_plain,  step_original, sum_moments,     sum_gram};

const probe::FitKernels& fit_kernels() {
  return fit_table;
}

}  // namespace nook::isa_scalar
