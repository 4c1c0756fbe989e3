// The kernels of characters for AVX2 and FMA.
#include "sdk/src/isa/avx2/vector.h"

#include "sdk/src/character/shadow_kernels_parts.h"

namespace nook::isa_avx2 {

using Wide = simd::Pair<Float>;  // the vector type of the loops over spheres

#include "sdk/src/character/shadow_kernels_impl.inl"
#include "sdk/src/character/shadow_kernels_impl_directional.inl"
#include "sdk/src/character/shadow_kernels_pose_simd.inl"
#include "sdk/src/character/shadow_kernels_table.inl"

}  // namespace nook::isa_avx2
