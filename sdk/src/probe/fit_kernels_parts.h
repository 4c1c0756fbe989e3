// The headers that fit_kernels_impl.inl needs. That file is included inside a namespace, so it cannot include
// them itself.
#pragma once

#include <nook/nook_probe.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>

#include "sdk/src/core/compiler.h"
#include "sdk/src/core/simd_polynomials.h"
#include "sdk/src/probe/fit_kernels.h"
#include "shaders/probe/constants.h"
