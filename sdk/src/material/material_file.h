// Materials as .nook files. Version 4 of the kind "MATL" has the sections
//   HEAD  u16 lights, views; u8 form of visibility, f32 threshold and weight of its mapping; u8 form of
//         numbers, 8 or 16 (version 1: always 16)
//   DIRS  lights, then views, three 32-bit floats each
//   LGHT  the light basis, packed
//   BTF_  the BTF: u16 width, height, rank_light, rank_view, rank_x, rank_y, clusters, u8 mixture; packed
//         cores, x bases, y bases; its rows
//   VOTF  the VOTF in the same form (optional)
//   BMAP  the BTF's resampled view map (optional): u16 side; its rows
//   VMAP  the VOTF's resampled view map (optional)
//   RELF  the relief (optional, from version 3 on): u8 steps, f32 low, high, max_slope, u8 levels
//   NEUR  a neural material (of version 4), which has neither LGHT nor BTF_, BMAP and RELF:
//         u16 width, height; u8 channels, units, layers, offset channels, offset units;
//         the blocks of its features and its weights, as in neural.h
//   RECP  recipe
// A file has the lowest version that can hold it: 4 for a neural material, 3 with a relief, else 2. Packed
// numbers of form 16 are an i8 exponent e, then each number as a half float h with the value h 2^e. In form 8
// they are multiples of a step (packed_numbers.h); a slab is the cores' last two modes, a cluster's basis, or
// everything. Rows are memberships in u8, or u16 above 256 clusters, and packed coefficients. With a single
// cluster there are no memberships. In form 8, map_rows.h describes the rows of maps.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sdk/src/core/container.h"
#include "sdk/src/core/memory.h"
#include "sdk/src/material/material.h"

namespace nook::material {

inline constexpr ContainerKind material_kind{four_letters("MATL"), "material", 1, 4};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if check_material finds a fault.
std::vector<std::byte> write_material(const Material& material);

// Hostile bytes are safe, also with a correct checksum: the call throws Failure(NOOK_ERROR_BAD_FILE or
// NOOK_ERROR_FILE_VERSION), and allocates in proportion to the file's size.
Material read_material(std::span<const std::byte> bytes, Memory* memory = default_memory());

// Returns the material after a write and a read, with its numbers rounded as in the file.
Material quantise(const Material& material);

}  // namespace nook::material
