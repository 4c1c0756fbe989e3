// The kernels of world casters, one float at a time.
#include "sdk/src/isa/scalar/vector.h"

#include "sdk/src/world/world_kernels_parts.h"

namespace nook::isa_scalar {

#include "sdk/src/world/world_kernels_impl.inl"

}  // namespace nook::isa_scalar
