// The kernels of radiance transfer for the SIMD of WebAssembly.
#include "sdk/src/isa/wasm128/vector.h"

#include "sdk/src/transfer/vector_kernels_parts.h"

namespace nook::isa_wasm128 {

#include "sdk/src/transfer/vector_kernels_impl.inl"

}  // namespace nook::isa_wasm128
