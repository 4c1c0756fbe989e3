// The instruction sets that kernels are compiled for, which isa_list.inl lists, and the choice of one at run
// time.
#pragma once

#include <nook/nook.h>

#include <cstdint>

namespace nook {

enum class Isa : std::int32_t {
#define NOOK_ISA_ENTRY(name, value, built, runs) name = (value),
#include "sdk/src/core/isa_list.inl"
};

// All of the list, also those that this build or processor lacks.
inline constexpr Isa all_isas[] = {
#define NOOK_ISA_ENTRY(name, value, built, runs) Isa::name,
#include "sdk/src/core/isa_list.inl"
};

// The largest value of the public header; 0 is NOOK_ISA_AUTO.
constexpr nook_isa last_isa() {
  nook_isa last = 0;
  for (const Isa isa : all_isas)
    if (static_cast<nook_isa>(isa) > last) last = static_cast<nook_isa>(isa);
  return last;
}

// Returns the name in isa_list.inl, or NULL for a value that is not there.
constexpr const char* isa_name(Isa isa) {
  switch (isa) {
#define NOOK_ISA_ENTRY(name, value, built, runs) \
  case Isa::name:                                \
    return #name;
#include "sdk/src/core/isa_list.inl"
  }
  return nullptr;
}

// Returns true if this build has the kernels and this processor runs them. Isa::scalar is always available.
bool isa_available(Isa isa);

// Returns the set of a public value, or the best available one for NOOK_ISA_AUTO. Throws Failure with
// NOOK_ERROR_INVALID_ARGUMENT for a value that is not in the list, and with NOOK_ERROR_UNSUPPORTED for a set
// that is not available; the message then names those that are.
Isa choose_isa(nook_isa asked);

// The instruction sets that both processor and operating system can run. All answers are false on processors
// of another family.

bool processor_has_sse2();
bool processor_has_avx2_and_fma();
bool processor_has_avx512f();

}  // namespace nook
