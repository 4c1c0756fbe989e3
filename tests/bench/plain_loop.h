// The maths of the shadow norm as anyone would write it first, compiled at -O2 without vectorisation: the
// yardstick of the SIMD kernels.
#pragma once

#include "sdk/src/character/shadow_kernels.h"

namespace nook::bench {

// The nook form; gamma is 1, 1.5 or 2.
void plain_norm_sum(const SphereSoa& spheres, const KeyPointSoa& points, float gamma, float* sum);

}  // namespace nook::bench
