// The reference: plain float arithmetic in the order of the formulas. Processors without x86 SIMD run it.
#include <cstdint>

#include "sdk/src/character/directional.h"
#include "sdk/src/character/directional_bands.h"
#include "sdk/src/character/kernel.h"
#include "sdk/src/character/shadow_kernels.h"
#include "sdk/src/character/shadow_kernels_tables.h"
#include "sdk/src/core/simd_pair.h"
#include "sdk/src/core/simd_scalar.h"

namespace nook::isa_scalar {

using Float = float;
constexpr std::uint32_t width = 1;
using Wide = Float;  // the vector of the loops over spheres

namespace {
Float broadcast(float a) {
  return a;
}
Float load(const float* p) {
  return *p;
}
void store(float* p, Float a) {
  *p = a;
}
}  // namespace

#include "sdk/src/character/shadow_kernels_impl.inl"
#include "sdk/src/character/shadow_kernels_impl_directional.inl"
#include "sdk/src/character/shadow_kernels_pose_scalar.inl"

constexpr ShadowKernels table{
    Isa::scalar,       "scalar",         self_norm_sum,        norm_root,
    composed_depth,    exact_open,       composed_occlusion,   linear_layer,
    pose_spheres,      pose_key_points,  directional_norm_sum, directional_hemisphere,
    directional_depth, directional_open, directional_ground};

const ShadowKernels& kernels() {
  return table;
}

}  // namespace nook::isa_scalar
