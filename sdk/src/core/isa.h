// The instruction sets that kernels are compiled for. The library queries at run time which of them the
// processor has.
#pragma once

#include <cstdint>

namespace nook {

enum class Isa : std::uint8_t { scalar = 0, sse2 = 1, avx2 = 2, avx512 = 3 };

}  // namespace nook
