// Chooses an instruction set at run time. Kernels are compiled for each instruction set in isa_list.inl.
#pragma once

#include <nook/nook.h>

#include <cstdint>

namespace nook {

enum class Isa : std::int32_t {
#define NOOK_ISA_ENTRY(name, value, built, runs) name = (value),
#include "sdk/src/core/isa_list.inl"
};

// All instruction sets of the list, including sets that this build or processor does not have.
inline constexpr Isa all_isas[] = {
#define NOOK_ISA_ENTRY(name, value, built, runs) Isa::name,
#include "sdk/src/core/isa_list.inl"
};

// Returns the largest value of nook_isa in the public header. The value 0 is NOOK_ISA_AUTO.
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

// Returns true if this build contains the kernels of the instruction set and this processor can run them.
// Isa::scalar is always available.
bool isa_available(Isa isa);

// Returns the instruction set for a public value. For NOOK_ISA_AUTO, returns the best available set. Throws
// Failure(NOOK_ERROR_INVALID_ARGUMENT) for a value that is not in the list. Throws
// Failure(NOOK_ERROR_UNSUPPORTED) for a set that is not available; the message lists the available sets.
Isa choose_isa(nook_isa asked);

// These functions return true if both the processor and the operating system support the set. They return
// false on processors of another family, such as ARM for an x86 set.

bool processor_has_sse2();
bool processor_has_avx2_and_fma();
bool processor_has_avx512f();

}  // namespace nook
