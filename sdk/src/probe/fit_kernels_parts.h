// The headers of fit_kernels_impl.inl, which is included inside a namespace.
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
