// The error of a material as it is drawn: decoded from the tables that textures hold, at the middles of
// texels, for the views and lights of the raw material. Rounding of the tables, the view map and the light
// map count.
#pragma once

#include "bakers/measure/material/measures.h"
#include "sdk/src/material/tables.h"

namespace nook::bake::material {

// Throws Failure(INVALID_ARGUMENT) where the sizes are not the raw material's.
BtfError measure_tables(const RawMaterial& raw, const nook::material::MaterialTables& tables);

// Returns the bytes of all textures over the texels of the BTF.
double table_bytes_texel(const nook::material::MaterialTables& tables);

}  // namespace nook::bake::material
