// The table of each instruction set's translation unit. A table may only be used on a processor that has the
// instruction set.
#pragma once

#include "sdk/src/transfer/vector_kernels.h"

#define NOOK_ISA_ENTRY(name, value, built, runs)     \
  namespace nook::isa_##name {                       \
    const transfer::VectorKernels& vector_kernels(); \
  }
#include "sdk/src/core/isa_list.inl"
