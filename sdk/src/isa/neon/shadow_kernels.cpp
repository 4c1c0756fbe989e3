// The kernels of characters for NEON.
#include "sdk/src/isa/neon/vector.h"

#include "sdk/src/character/shadow_kernels_parts.h"

namespace nook::isa_neon {

using Wide = simd::Pair<Float>;  // the vector type of the loops over spheres

#include "sdk/src/character/shadow_kernels_impl.inl"
#include "sdk/src/character/shadow_kernels_impl_directional.inl"
#include "sdk/src/character/shadow_kernels_pose_simd.inl"
#include "sdk/src/character/shadow_kernels_table.inl"

}  // namespace nook::isa_neon
