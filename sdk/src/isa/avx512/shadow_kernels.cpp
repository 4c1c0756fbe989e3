// The kernels of characters for AVX-512F.
#include "sdk/src/isa/avx512/vector.h"

#include "sdk/src/character/shadow_kernels_parts.h"

namespace nook::isa_avx512 {

using Wide = simd::Pair<Float>;  // what the loops over spheres run on

#include "sdk/src/character/shadow_kernels_impl.inl"
#include "sdk/src/character/shadow_kernels_impl_directional.inl"
#include "sdk/src/character/shadow_kernels_pose_simd.inl"
#include "sdk/src/character/shadow_kernels_table.inl"

}  // namespace nook::isa_avx512
