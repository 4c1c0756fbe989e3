// The kernels of radiance transfer for AVX-512F.
#include "sdk/src/isa/avx512/vector.h"

#include "sdk/src/transfer/vector_kernels_parts.h"

namespace nook::isa_avx512 {

#include "sdk/src/transfer/vector_kernels_impl.inl"

}  // namespace nook::isa_avx512
