// The headers of world_kernels_impl.inl, which is included inside a namespace.
#pragma once

#include <cstdint>

#include "sdk/src/world/cone.h"
#include "sdk/src/world/coverage.h"
#include "sdk/src/world/world_kernels.h"
