// The kernels for SSE2.
#include "sdk/src/core/simd_sse2.h"

#include "sdk/src/character/directional.h"
#include "sdk/src/character/directional_bands.h"
#include "sdk/src/character/kernel.h"
#include "sdk/src/character/shadow_kernels.h"
#include "sdk/src/character/shadow_kernels_tables.h"
#include "sdk/src/core/simd_pair.h"

namespace nook::isa_sse2 {

using Wide = Float;  // what the loops over spheres run on

#include "sdk/src/character/shadow_kernels_impl.inl"
#include "sdk/src/character/shadow_kernels_impl_directional.inl"
#include "sdk/src/character/shadow_kernels_pose_x86.inl"

constexpr ShadowKernels table{
    Isa::sse2,         "sse2",           self_norm_sum,        norm_root,
    composed_depth,    exact_open,       composed_occlusion,   linear_layer,
    pose_spheres,      pose_key_points,  directional_norm_sum, directional_hemisphere,
    directional_depth, directional_open, directional_ground};

const ShadowKernels& kernels() {
  return table;
}

}  // namespace nook::isa_sse2
