// Probes as .nook files. The kind "PROB" has the sections
//   HEAD u8 kind, u8 domain, u8 ambient, u8 order, u8 functions, u8 packing;
//        f32: up 3; u32: counts 3; f32: origin_ws 3, spacing_ws 3
//   LOBE Gaussians only: for each function axis 3 f32 and sharpness f32
//   COEF coefficients, probe by probe, packed as HEAD says: 3 f32, 3 half floats, or one RGB9E5 word
//   RECP recipe, JSON; may be empty
//   WALL version 2, only of grids with walls: f32 bias; for each cell, as walls.h has them, its planes, 4
//   half
//        floats each, and a byte for each side
// A grid without walls is written as version 1, which older libraries read.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sdk/src/core/container.h"
#include "sdk/src/core/memory.h"
#include "sdk/src/probe/packing.h"
#include "sdk/src/probe/probe.h"

namespace nook::probe {

inline constexpr ContainerKind probe_kind{four_letters("PROB"), "light probe", 1, 2};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) for what check_probes refuses, and for coefficients that the
// packing cannot hold.
std::vector<std::byte> write_probes(const Probes& probes, Packing packing);

// Safe on hostile bytes, also with a right checksum: throws Failure(NOOK_ERROR_BAD_FILE or
// NOOK_ERROR_FILE_VERSION), and allocates no more than the coefficients and the recipe.
Probes read_probes(std::span<const std::byte> bytes, Memory* memory = default_memory());
Packing packing_of(std::span<const std::byte> bytes);

}  // namespace nook::probe
