// The kernels of characters for the SIMD of WebAssembly.
#include "sdk/src/isa/wasm128/vector.h"

#include "sdk/src/character/shadow_kernels_parts.h"

namespace nook::isa_wasm128 {

using Wide = Float;  // the vector type of the loops over spheres

#include "sdk/src/character/shadow_kernels_impl.inl"
#include "sdk/src/character/shadow_kernels_impl_directional.inl"
#include "sdk/src/character/shadow_kernels_pose_simd.inl"
#include "sdk/src/character/shadow_kernels_table.inl"

}  // namespace nook::isa_wasm128
