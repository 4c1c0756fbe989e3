#include "sdk/src/character/shadow_kernels.h"

#include <initializer_list>

#include "sdk/src/character/shadow_kernels_tables.h"

namespace nook {

const ShadowKernels* shadow_kernels(Isa isa) {
  switch (isa) {
    case Isa::scalar:
      return &isa_scalar::kernels();
#ifdef NOOK_X86_KERNELS
    case Isa::sse2:
      return __builtin_cpu_supports("sse2") ? &isa_sse2::kernels() : nullptr;
    case Isa::avx2:
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? &isa_avx2::kernels() : nullptr;
    case Isa::avx512:
      return __builtin_cpu_supports("avx512f") ? &isa_avx512::kernels() : nullptr;
#endif
    default:
      return nullptr;
  }
}

const ShadowKernels& best_shadow_kernels() {
  for (const Isa isa : {Isa::avx512, Isa::avx2, Isa::sse2})
    if (const ShadowKernels* kernels = shadow_kernels(isa)) return *kernels;
  return isa_scalar::kernels();
}

}  // namespace nook
