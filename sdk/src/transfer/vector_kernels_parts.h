// The headers of vector_kernels_impl.inl, which is included inside a namespace.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "sdk/src/transfer/vector_kernels.h"
