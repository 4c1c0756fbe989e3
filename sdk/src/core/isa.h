// Chooses at run time among the instruction sets of isa_list.inl, for which kernels are compiled.
#pragma once

#include <nook/nook.h>

#include <cstdint>

namespace nook {

enum class Isa : std::int32_t {
#define NOOK_ISA_ENTRY(name, value, built, runs) name = (value),
#include "sdk/src/core/isa_list.inl"
};

// All sets of the list, even those that this build or processor lacks.
inline constexpr Isa all_isas[] = {
#define NOOK_ISA_ENTRY(name, value, built, runs) Isa::name,
#include "sdk/src/core/isa_list.inl"
};

// The largest value in the public header; 0 is NOOK_ISA_AUTO.
constexpr nook_isa last_isa() {
  nook_isa last = 0;
  for (const Isa isa : all_isas)
    if (static_cast<nook_isa>(isa) > last) last = static_cast<nook_isa>(isa);
  return last;
}

// Returns the name in isa_list.inl, or NULL for a value that is not in the list.
constexpr const char* isa_name(Isa isa) {
  switch (isa) {
#define NOOK_ISA_ENTRY(name, value, built, runs) \
  case Isa::name:                                \
    return #name;
#include "sdk/src/core/isa_list.inl"
  }
  return nullptr;
}

// Returns true if this build has the kernels and this processor can run them. Isa::scalar is always
// available.
bool isa_available(Isa isa);

// Returns the set of a public value, or the best available one for NOOK_ISA_AUTO. Throws Failure with
// NOOK_ERROR_INVALID_ARGUMENT for a value that is not in the list. For a set that is not available it throws
// NOOK_ERROR_UNSUPPORTED, and the message names the available sets.
Isa choose_isa(nook_isa asked);

// Return true if both processor and operating system can run the set; always false on processors of another
// family.

bool processor_has_sse2();
bool processor_has_avx2_and_fma();
bool processor_has_avx512f();

}  // namespace nook
