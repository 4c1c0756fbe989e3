// The kernels of probe fits for NEON.
#include "sdk/src/isa/neon/vector.h"

#include "sdk/src/probe/fit_kernels_parts.h"

namespace nook::isa_neon {

#include "sdk/src/probe/fit_kernels_impl.inl"

}  // namespace nook::isa_neon
