// Chooses the kernels for an instruction set.
#include "sdk/src/character/shadow_kernels.h"

namespace nook {

const ShadowKernels* shadow_kernels(Isa isa) {
  if (!isa_available(isa)) return nullptr;
#define NOOK_ISA_ENTRY(name, value, built, runs) \
  if constexpr (built)                           \
    if (isa == Isa::name) return &isa_##name::kernels();
#include "sdk/src/core/isa_list.inl"
  return nullptr;
}

const ShadowKernels& best_shadow_kernels() {
  return *shadow_kernels(choose_isa(NOOK_ISA_AUTO));
}

}  // namespace nook
