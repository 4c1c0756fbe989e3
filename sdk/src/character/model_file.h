// Character models as .nook files. Version 2 of the kind "CHAR" has the sections
//   HEAD kernel, bounds   BONE names   SPHR proxy spheres   KEYP key points   LINR linear layer
//   STAO static AO, one byte a welded vertex (may be missing)   FMAP file order   PRIM primitives
//   LODS levels of detail (may be missing)   RECP recipe
// Numbers are quantised to what the error budget allows; model_file_packing.h says how.
#pragma once

#include <cstddef>
#include <memory_resource>
#include <span>
#include <vector>

#include "sdk/src/character/model.h"
#include "sdk/src/core/container.h"

namespace nook {

inline constexpr ContainerKind character_kind{four_letters("CHAR"), "character model", 2, 2};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if the model fails check_model.
std::vector<std::byte> write_character_model(const CharacterModel& model);

// Safe on hostile bytes, also with a right checksum: throws Failure(NOOK_ERROR_BAD_FILE or
// NOOK_ERROR_FILE_VERSION), and allocates no more than a small multiple of the file's size.
CharacterModel read_character_model(std::span<const std::byte> bytes,
                                    std::pmr::memory_resource* memory = std::pmr::get_default_resource());

// What a model becomes by being written and read, so that the bakers can measure what quantisation costs.
CharacterModel quantise(const CharacterModel& model);

}  // namespace nook
