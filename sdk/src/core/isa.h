// Instruction sets that kernels are compiled for; which of them the processor has is asked at run time.
#pragma once

#include <cstdint>

namespace nook {

enum class Isa : std::uint8_t { scalar = 0, sse2 = 1, avx2 = 2, avx512 = 3 };

}  // namespace nook
