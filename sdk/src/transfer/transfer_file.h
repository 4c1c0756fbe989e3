// Baked transfer as .nook files. Version 1 of the kind "TRAN" has the sections
//   HEAD  u8 form, 0: separated, 1: paper; u8 bounces, 0 to 2; u16 lobes; u32 vertices;
//         u64 hashes of positions, normals, tangents and texture coordinates
//   CODE  vertices x lobes codes of 2 bits, low bits first; every vertex starts at a whole byte. Code 0 means
//         the share 0, 1 the share 255, 2 the next byte of SHAR; 3 is invalid
//   SHAR  the shares of code 2, u8
//   FRAM  vertices x 3 u16, see tangent_frame.h
// The paper's form has these sections instead of CODE, SHAR and FRAM:
//   PAPR  u16 light modes, clusters, lobe rank, vertex rank; u64 hash of the material's light; f32 scale
//   LOBE, CORE, CLUS, COEF  the arrays of paper.h: half floats, and u8 for clusters
// Both forms have the sections
//   INDI  vertices x bounces x 9 half floats of reflected light; only if bounces is above 0
//   HOLE  u64 hash of the VOTF that defined the holes of surfaces in the bake; only if there was one
//   RECP  recipe
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sdk/src/core/container.h"
#include "sdk/src/core/memory.h"
#include "sdk/src/transfer/transfer.h"

namespace nook::transfer {

inline constexpr ContainerKind transfer_kind{four_letters("TRAN"), "radiance transfer", 1, 1};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if check_transfer rejects the transfer.
std::vector<std::byte> write_transfer(const Transfer& transfer);

// Safe for untrusted bytes, even if their checksum is correct. For an invalid file, the call throws
// Failure(NOOK_ERROR_BAD_FILE or NOOK_ERROR_FILE_VERSION). It allocates at most five times the file's size.
Transfer read_transfer(std::span<const std::byte> bytes, Memory* memory = default_memory());

}  // namespace nook::transfer
