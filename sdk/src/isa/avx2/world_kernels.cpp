// The kernels of world casters for AVX2 and FMA.
#include "sdk/src/isa/avx2/vector.h"

#include "sdk/src/world/world_kernels_parts.h"

namespace nook::isa_avx2 {

#include "sdk/src/world/world_kernels_impl.inl"

}  // namespace nook::isa_avx2
