// Includes the headers that world_kernels_impl.inl needs. The .inl file cannot include them, because it is
// itself included inside a namespace.
#pragma once

#include <cstdint>

#include "sdk/src/world/cone.h"
#include "sdk/src/world/coverage.h"
#include "sdk/src/world/world_kernels.h"
