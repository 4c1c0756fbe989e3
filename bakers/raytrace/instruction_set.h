// Chooses the instruction set of a bake. Bakers sum floats in SIMD registers. Wider registers and fused
// multiply-adds round these sums differently, so each instruction set gives different results. The
// environment variable NOOK_ISA pins the instruction set of kernels, clones (clones.h) and Embree for the
// whole process. The C library chooses its own versions of math functions when a process starts. So `nook
// bake --isa` restarts the tool with both choices pinned.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sdk/src/core/isa.h"

namespace nook::bake {

// The levels of the x86-64 psABI. Other processors have only one level, `baseline`.
enum class IsaLevel : std::uint8_t { baseline, v2, v3, v4 };

inline constexpr const char* isa_variable = "NOOK_ISA";

// Returns the level with a name: native, x86-64-v2 or x86-64-v3. Throws Failure: INVALID_ARGUMENT for another
// name, UNSUPPORTED if this processor lacks the level.
IsaLevel isa_level_of(std::string_view name);

// Returns the level that this process bakes with: the level that NOOK_ISA names, or else the best level of
// the processor. NOOK_ISA is read only once, so later changes have no effect. Throws the same failures as
// isa_level_of.
IsaLevel isa_level();

// Returns the name of the level as it is stored in recipes, such as x86-64-v3. On other processors, returns
// the name of the processor family.
std::string isa_level_name();

// Returns the instruction set of the sdk's kernels at this level.
Isa kernel_isa();

// Returns the configuration string that limits an Embree device to this level. It is empty for the best
// level.
const char* embree_isa();

// Returns the version of the Embree library that the program runs with, such as "3.13.5" (ray_scene.cpp).
std::string embree_version();

}  // namespace nook::bake
