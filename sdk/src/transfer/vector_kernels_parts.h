// The headers that vector_kernels_impl.inl needs. That file is included inside a namespace, so it cannot
// include them itself.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "sdk/src/transfer/vector_kernels.h"
