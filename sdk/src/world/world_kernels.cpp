#include "sdk/src/world/world_kernels.h"

#include "sdk/src/world/world_kernels_tables.h"

namespace nook::world {

const WorldKernels* world_kernels(Isa isa) {
  if (!isa_available(isa)) return nullptr;
#define NOOK_ISA_ENTRY(name, value, built, runs) \
  if constexpr (built)                           \
    if (isa == Isa::name) return &isa_##name::world_kernels();
#include "sdk/src/core/isa_list.inl"
  return nullptr;
}

}  // namespace nook::world
