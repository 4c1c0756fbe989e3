// Character models as .nook files. Version 4 of the kind "CHAR" has the sections
//   HEAD kernel, bounds   BONE names   SPHR proxy spheres   KEYP key points   LINR linear layer
//   STAO static AO, one byte for each welded vertex (optional)   FMAP file order   PRIM primitives
//   LODS levels of detail (optional)   RECP recipe
//   BIND bind data (optional)   REST rest positions and normals of the welded vertices (optional)
//   WCAS world casters (optional)   BENT occluded directions of the welded vertices (optional)
//   SATU saturations of the key points (optional, all 0 without it)
//   NEAR exact positions of welded vertices that are very close to others, and weights if these differ
//   (optional).
// Readers also accept version 2, without BIND and REST, and version 3, without SATU. Values are quantised
// within the error budget. model_file_packing.h lists the bits of each field.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sdk/src/character/model.h"
#include "sdk/src/core/container.h"
#include "sdk/src/core/memory.h"

namespace nook {

inline constexpr ContainerKind character_kind{four_letters("CHAR"), "character model", 2, 4};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if the model fails check_model.
std::vector<std::byte> write_character_model(const CharacterModel& model);

// Safe for untrusted bytes, even if their checksum is correct. For an invalid file, the call throws
// Failure(NOOK_ERROR_BAD_FILE or NOOK_ERROR_FILE_VERSION). It never allocates more than a small multiple of
// the file's size.
CharacterModel read_character_model(std::span<const std::byte> bytes, Memory* memory = default_memory());

// Returns the model as it is after it was written to a file and read again. Bakers use it to measure the
// quantisation error.
CharacterModel quantise(const CharacterModel& model);

}  // namespace nook
