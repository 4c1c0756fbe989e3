// Includes the headers that the kernels' .inl files need. The .inl files cannot include them, because they
// are themselves included inside a namespace.
#pragma once

#include <cstdint>

#include "sdk/src/character/directional_occlusion.h"
#include "sdk/src/character/kernel.h"
#include "sdk/src/character/shadow_kernels.h"
#include "sdk/src/core/compiler.h"
#include "sdk/src/core/simd_pair.h"
