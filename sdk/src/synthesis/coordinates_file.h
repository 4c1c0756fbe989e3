// Coordinate textures as .nook files. Version 1 of the kind "SYNT" has the sections
//   HEAD  u16 side of the plane, width and height of the material, in texels
//   CELL  side x side pairs of u16 x, y
//   RECP  recipe
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sdk/src/core/container.h"
#include "sdk/src/synthesis/coordinates.h"

namespace nook::synthesis {

inline constexpr ContainerKind synthesis_kind{four_letters("SYNT"), "synthesis", 1, 1};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if check_coordinates finds a fault.
std::vector<std::byte> write_coordinates(const Coordinates& coordinates);

// Hostile bytes are safe, also with a correct checksum: the call throws Failure(NOOK_ERROR_BAD_FILE or
// NOOK_ERROR_FILE_VERSION), and allocates in proportion to the file's size.
Coordinates read_coordinates(std::span<const std::byte> bytes, Memory* memory = default_memory());

}  // namespace nook::synthesis
