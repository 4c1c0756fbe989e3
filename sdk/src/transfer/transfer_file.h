// Baked transfer as .nook files. Version 1 of the kind "TRAN" has the sections
//   HEAD  u8 form, 0: separated, 1: paper; u8 bounces, 0 to 2; u16 lobes; u32 vertices;
//         u64 hashes of positions, normals, tangents and texture coordinates
//   CODE  vertices x lobes, 2 bits each, low bits first, every vertex from a whole byte on: 0 is the share 0,
//         1 is 255, 2 is a byte of SHAR; 3 is refused
//   SHAR  the shares of code 2, u8
//   FRAM  vertices x 3 u16, see tangent_frame.h
// and in the paper's form, in place of CODE, SHAR and FRAM,
//   PAPR  u16 light modes, clusters, lobe rank, vertex rank; u64 hash of the material's light; f32 scale
//   LOBE, CORE, CLUS, COEF  the arrays of paper.h: half floats, and u8 for clusters
//   INDI  vertices x bounces x 9 half floats of reflected light; only if there are bounces
//   HOLE  u64 hash of the VOTF through whose holes light fell; only if it did
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
