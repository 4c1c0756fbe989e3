// Ranks that suit the built-in meso-structures.
#pragma once

#include "bakers/material/compression.h"

namespace nook::bake::material {

// Sets the ranks of a material by its name; of a smaller version as many as it allows. False, and nothing
// set, where the name is none of those in meso_surface.h.
bool set_builtin_ranks(const RawMaterial& raw, CompressionSettings& settings);

}  // namespace nook::bake::material
