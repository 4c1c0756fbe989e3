// Materials as .nook files. Version 4 of the kind "MATL" has the sections
//   HEAD  u16 lights, views; u8 form of visibility, f32 threshold and weight of its mapping; u8 number
//         format `bits`, 8 or 16 (not in version 1, which always uses 16)
//   DIRS  lights, then views, three 32-bit floats each
//   LGHT  the light basis, packed
//   BTF_  the BTF: u16 width, height, rank_light, rank_view, rank_x, rank_y, clusters, u8 mixture; packed
//         cores, x bases, y bases; its rows
//   VOTF  the VOTF in the same form (optional)
//   BMAP  the BTF's resampled view map (optional): u16 side; its rows
//   VMAP  the VOTF's resampled view map (optional)
//   RELF  the relief (optional, from version 3 on): u8 steps, f32 low, high, max_slope, u8 levels
//   NEUR  a neural material (from version 4 on), which has no LGHT, BTF_, BMAP and RELF:
//         u16 width, height; u8 channels, units, layers, offset channels, offset units;
//         the blocks of its features and its weights, as in neural.h
//   RECP  recipe
// The writer chooses the lowest version that can represent the material: 4 for a neural material, 3 with a
// relief, otherwise 2. Packed arrays of form 16 start with an i8 exponent e; each value is then a half float
// h, which means h 2^e. Packed arrays of form 8 are multiples of a step (packed_numbers.h). Their slabs are
// the last two modes of a core, one cluster's basis, or the whole array. Rows consist of memberships and
// packed coefficients. A membership is a u8, or a u16 if there are more than 256 clusters. With a single
// cluster there are no memberships. In form 8, the rows of maps are stored as described in map_rows.h.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sdk/src/core/container.h"
#include "sdk/src/core/memory.h"
#include "sdk/src/material/material.h"

namespace nook::material {

inline constexpr ContainerKind material_kind{four_letters("MATL"), "material", 1, 4};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if check_material rejects the material.
std::vector<std::byte> write_material(const Material& material);

// Safe for untrusted bytes, even if their checksum is correct. For an invalid file, the call throws
// Failure(NOOK_ERROR_BAD_FILE or NOOK_ERROR_FILE_VERSION). It allocates memory in proportion to the file's
// size.
Material read_material(std::span<const std::byte> bytes, Memory* memory = default_memory());

// Returns the material as it is after writing and reading a file, with all values rounded.
Material quantise(const Material& material);

}  // namespace nook::material
