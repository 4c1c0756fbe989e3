// The kernels of world casters for SSE2.
#include "sdk/src/isa/sse2/vector.h"

#include "sdk/src/world/world_kernels_parts.h"

namespace nook::isa_sse2 {

#include "sdk/src/world/world_kernels_impl.inl"

}  // namespace nook::isa_sse2
