// The loop over spheres of the default kernel, for neon_cost.py, which reads its machine
// code. VECTOR is the header of an instruction set, ISA_NAMESPACE its namespace, WIDE the vector of the loop.
#include VECTOR

#include "sdk/src/character/shadow_kernels_parts.h"

namespace nook::ISA_NAMESPACE {

using Wide = WIDE;

#include "sdk/src/character/shadow_kernels_impl.inl"

}  // namespace nook::ISA_NAMESPACE

using namespace nook;

extern "C" void hot_loop(const SphereSoa& spheres, const KeyPointSoa& points, float* sum) {
  using namespace nook::ISA_NAMESPACE;
  norm_sum<KernelForm::nook, NormPower::one>(spheres, points, 1.0f, sum);
}
