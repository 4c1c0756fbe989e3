#include "sdk/src/probe/fit_kernels.h"

#include <initializer_list>

#include "sdk/src/probe/fit_kernels_tables.h"

namespace nook::probe {

const FitKernels* fit_kernels(Isa isa) {
  switch (isa) {
    case Isa::scalar:
      return &isa_scalar::fit_kernels();
#ifdef NOOK_X86_KERNELS
    case Isa::sse2:
      return __builtin_cpu_supports("sse2") ? &isa_sse2::fit_kernels() : nullptr;
    case Isa::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? &isa_avx2::fit_kernels()
                                                                             : nullptr;
    case Isa::avx512:
      return __builtin_cpu_supports("avx512f") ? &isa_avx512::fit_kernels() : nullptr;
#endif
    default:
      return nullptr;
  }
}

const FitKernels& best_fit_kernels() {
  for (const Isa isa : {Isa::avx512, Isa::avx2, Isa::sse2})
    if (const FitKernels* kernels = fit_kernels(isa)) return *kernels;
  return isa_scalar::fit_kernels();
}

}  // namespace nook::probe
