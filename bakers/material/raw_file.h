// Raw materials as files, so that what was compressed can be judged later. A .nook container of the kind
// "MRAW", version 2 (in version 1 the BTF was black where views pass through), with the sections
//   HEAD  u32 lights, views, width, height; u32 1 with a VOTF; u32 length and bytes of the name
//   DIRS  f32 x, y, z of the lights, then of the views
//   BTF_  half floats, in the order of RawMaterial::btf
//   MASK  with a VOTF one bit a texel, low bits first
#pragma once

#include <span>

#include "bakers/material/raw_material.h"
#include "sdk/src/core/container.h"

namespace nook::bake::material {

inline constexpr ContainerKind raw_kind{four_letters("MRAW"), "raw material", 2, 2};

std::vector<std::byte> write_raw_material(const RawMaterial& raw);

// Throws Failure(NOOK_ERROR_BAD_FILE); a texel that is not finite is named.
RawMaterial read_raw_material(std::span<const std::byte> bytes);

// Throws Failure(NOOK_ERROR_BAD_FILE) that names the first texel that is not finite by light, channel, view,
// x and y, or the first direction that is no unit vector of the upper hemisphere or is there twice.
void check_raw_material(const RawMaterial& raw);

}  // namespace nook::bake::material
