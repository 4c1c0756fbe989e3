// The kernels of radiance transfer for AVX2 and FMA.
#include "sdk/src/isa/avx2/vector.h"

#include "sdk/src/transfer/vector_kernels_parts.h"

namespace nook::isa_avx2 {

#include "sdk/src/transfer/vector_kernels_impl.inl"

}  // namespace nook::isa_avx2
