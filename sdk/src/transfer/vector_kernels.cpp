#include "sdk/src/transfer/vector_kernels.h"

#include "sdk/src/transfer/vector_kernels_tables.h"

namespace nook::transfer {

const VectorKernels* vector_kernels(Isa isa) {
  if (!isa_available(isa)) return nullptr;
#define NOOK_ISA_ENTRY(name, value, built, runs) \
  if constexpr (built)                           \
    if (isa == Isa::name) return &isa_##name::vector_kernels();
#include "sdk/src/core/isa_list.inl"
  return nullptr;
}

}  // namespace nook::transfer
