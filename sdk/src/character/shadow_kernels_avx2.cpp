// The kernels for AVX2 and FMA.
#include "core/simd_avx2.h"

#include "character/directional.h"
#include "character/directional_bands.h"
#include "character/kernel.h"
#include "character/shadow_kernels.h"
#include "character/shadow_kernels_tables.h"
#include "core/simd_pair.h"

namespace nook::isa_avx2 {

using Wide = simd::Pair<Float>;  // the vector of the loops over spheres

#include "character/shadow_kernels_impl.inl"
#include "character/shadow_kernels_impl_directional.inl"
#include "character/shadow_kernels_pose_x86.inl"

constexpr ShadowKernels table{Isa::avx2,
                              "avx2",
                              self_norm_sum,
                              norm_root,
                              composed_depth,
                              exact_open,
                              composed_occlusion,
                              linear_layer,
                              scatter,
                              pose_spheres,
                              pose_key_points,
                              directional_norm_sum,
                              directional_hemisphere,
                              directional_depth,
                              directional_open,
                              directional_ground};

const ShadowKernels& kernels() {
  return table;
}

}  // namespace nook::isa_avx2
