// The kernels of characters for AVX-512F.
#include "sdk/src/isa/avx512/vector.h"

#include "sdk/src/character/shadow_kernels_parts.h"

namespace nook::isa_avx512 {

using Wide = simd::Pair<Float>;  // the vector type of the loops over spheres

#include "sdk/src/character/shadow_kernels_impl.inl"
#include "sdk/src/character/shadow_kernels_impl_directional.inl"
#include "sdk/src/character/shadow_kernels_pose_simd.inl"
#include "sdk/src/character/shadow_kernels_table.inl"

}  // namespace nook::isa_avx512
