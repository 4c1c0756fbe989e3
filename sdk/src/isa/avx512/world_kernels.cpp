// The kernels of world casters for AVX-512F.
#include "sdk/src/isa/avx512/vector.h"

#include "sdk/src/world/world_kernels_parts.h"

namespace nook::isa_avx512 {

#include "sdk/src/world/world_kernels_impl.inl"

}  // namespace nook::isa_avx512
