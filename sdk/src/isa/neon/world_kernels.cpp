// The kernels of world casters for NEON.
#include "sdk/src/isa/neon/vector.h"

#include "sdk/src/world/world_kernels_parts.h"

namespace nook::isa_neon {

#include "sdk/src/world/world_kernels_impl.inl"

}  // namespace nook::isa_neon
