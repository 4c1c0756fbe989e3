// Baked clips as .nook files. Version 1 of the kind "CLIP" has the sections
//   HEAD  u64 hash of the model's orders; u32 frames, welded vertices; u16 modes of AO, modes of the pose
//   NAME  varint number of clips; for each: varint length and bytes of its name, f32 seconds, varint frames
//   AO    f32 scale of each mode; frames x modes i16 weights; modes x vertices i8
//   BONE  varint number of bones; for each: f32 centre x, y, z, radius
//   POSE  f32 scale of each mode; frames x modes i16 weights; modes x 12 bones i16
//   RECP  recipe
// with the meaning that clip_set.h gives.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sdk/src/character/clip_set.h"
#include "sdk/src/core/container.h"

namespace nook {

inline constexpr ContainerKind clip_kind{four_letters("CLIP"), "clips", 1, 1};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if check_clip_set finds a fault.
std::vector<std::byte> write_clip_set(const ClipSet& set);

// Hostile bytes are safe, also with a correct checksum: the call throws Failure(NOOK_ERROR_BAD_FILE or
// NOOK_ERROR_FILE_VERSION), and allocates up to twice the file's size.
ClipSet read_clip_set(std::span<const std::byte> bytes, Memory* memory = default_memory());

}  // namespace nook
