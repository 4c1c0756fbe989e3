// The kernels of radiance transfer for NEON.
#include "sdk/src/isa/neon/vector.h"

#include "sdk/src/transfer/vector_kernels_parts.h"

namespace nook::isa_neon {

#include "sdk/src/transfer/vector_kernels_impl.inl"

}  // namespace nook::isa_neon
