// The kernels of world casters for the SIMD of WebAssembly.
#include "sdk/src/isa/wasm128/vector.h"

#include "sdk/src/world/world_kernels_parts.h"

namespace nook::isa_wasm128 {

#include "sdk/src/world/world_kernels_impl.inl"

}  // namespace nook::isa_wasm128
