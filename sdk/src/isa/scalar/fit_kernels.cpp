// The kernels of probe fits, one float at a time.
#include "sdk/src/isa/scalar/vector.h"

#include "sdk/src/probe/fit_kernels_parts.h"

namespace nook::isa_scalar {

#include "sdk/src/probe/fit_kernels_impl.inl"

}  // namespace nook::isa_scalar
