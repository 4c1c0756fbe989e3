// Materials as .nook files. Version 1 of the kind "MATL" has the sections
//   HEAD  u16 lights, views; u8 form of visibility, f32 threshold and weight of its mapping
//   DIRS  lights, then views, three 32-bit floats each
//   LGHT  the light basis, packed
//   BTF_  the BTF: u16 width, height, rank_light, rank_view, rank_x, rank_y, clusters, u8 mixture; packed
//         cores, x bases, y bases; its rows
//   VOTF  the VOTF likewise, where there is one
//   BMAP  the BTF's resampled view map, where there is one: u16 side; its rows
//   VMAP  the VOTF's
//   RECP  recipe
// Packed is an i8 exponent e, then each number as a half float h, worth h 2^e. Rows are memberships in u8, or
// u16 above 256 clusters, none where there is but one cluster; then packed coefficients.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <span>
#include <vector>

#include "sdk/src/core/container.h"
#include "sdk/src/material/material.h"

namespace nook::material {

inline constexpr ContainerKind material_kind{four_letters("MATL"), "material", 1, 1};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) where check_material finds a fault.
std::vector<std::byte> write_material(const Material& material);

// Safe on hostile bytes, also with a right checksum: throws Failure(NOOK_ERROR_BAD_FILE or
// NOOK_ERROR_FILE_VERSION), and allocates in proportion to the file's size.
Material read_material(std::span<const std::byte> bytes,
                       std::pmr::memory_resource* memory = std::pmr::get_default_resource());

// What the file gives back: the numbers rounded to what it stores.
Material quantise(const Material& material);

}  // namespace nook::material
