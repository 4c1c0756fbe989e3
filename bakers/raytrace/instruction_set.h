// The instruction set of a bake. Bakers sum floats in registers, and wider registers and fused products round
// in another order, so that each set has results of its own. The environment variable NOOK_ISA pins one for
// the whole process: kernels, clones (clones.h) and Embree. The paths of the mathematics library are chosen
// by the C library when a process starts; `nook bake --isa` starts itself again with both pinned.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sdk/src/core/isa.h"

namespace nook::bake {

// The levels of the x86-64 psABI. Other processors have one level, which counts as baseline.
enum class IsaLevel : std::uint8_t { baseline, v2, v3, v4 };

inline constexpr const char* isa_variable = "NOOK_ISA";

// Returns the level of a name: native, x86-64-v2 or x86-64-v3. Throws Failure: INVALID_ARGUMENT for another
// name, UNSUPPORTED if this processor lacks the level.
IsaLevel isa_level_of(std::string_view name);

// Returns the level that this process bakes with: the best of the processor, or what NOOK_ISA names. It is
// read once; a change of the variable afterwards has no effect. Throws what isa_level_of throws.
IsaLevel isa_level();

// Returns the name of the level as recipes have it, such as x86-64-v3; of other processors the name of their
// family.
std::string isa_level_name();

// Returns the instruction set of the sdk's kernels at this level.
Isa kernel_isa();

// Returns the part of the configuration of an Embree device that pins its instruction set; empty for the
// best.
const char* embree_isa();

// Returns the version of the Embree that the program runs with, such as "3.13.5" (ray_scene.cpp).
std::string embree_version();

}  // namespace nook::bake
