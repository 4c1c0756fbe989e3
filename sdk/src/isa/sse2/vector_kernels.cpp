// The kernels of radiance transfer for SSE2.
#include "sdk/src/isa/sse2/vector.h"

#include "sdk/src/transfer/vector_kernels_parts.h"

namespace nook::isa_sse2 {

#include "sdk/src/transfer/vector_kernels_impl.inl"

}  // namespace nook::isa_sse2
