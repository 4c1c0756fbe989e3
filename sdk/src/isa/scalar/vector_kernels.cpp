// The kernels of radiance transfer, one float at a time.
#include "sdk/src/isa/scalar/vector.h"

#include "sdk/src/transfer/vector_kernels_parts.h"

namespace nook::isa_scalar {

#include "sdk/src/transfer/vector_kernels_impl.inl"

}  // namespace nook::isa_scalar
