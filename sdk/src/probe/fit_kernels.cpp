#include "sdk/src/probe/fit_kernels.h"

#include "sdk/src/probe/fit_kernels_tables.h"

namespace nook::probe {

const FitKernels* fit_kernels(Isa isa) {
  if (!isa_available(isa)) return nullptr;
#define NOOK_ISA_ENTRY(name, value, built, runs) \
  if constexpr (built)                           \
    if (isa == Isa::name) return &isa_##name::fit_kernels();
#include "sdk/src/core/isa_list.inl"
  return nullptr;
}

}  // namespace nook::probe
