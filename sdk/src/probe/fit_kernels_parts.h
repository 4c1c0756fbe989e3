// The headers of fit_kernels_impl.inl, which is included inside a namespace.
#pragma once

#include <nook/nook_probe.h>

#include <algorithm>
#include <cstdint>

#include "sdk/src/probe/fit_kernels.h"
#include "sdk/src/probe/fit_kernels_tables.h"
#include "shaders/probe/constants.h"
