// The error of a material as it is drawn: decoded from the tables that textures hold, at the middles of
// texels, for the views and lights of the raw material. Rounding of the tables, the view map and the light
// map count.
#pragma once

#include "bakers/material/btf_error.h"
#include "sdk/src/material/tables.h"

namespace nook::bake::material {

// The light basis of all lights and channels of the raw material, 3 lights x light modes.
tensor::Matrix light_rows(const RawMaterial& raw, const nook::material::MaterialTables& tables);

// Throws Failure(INVALID_ARGUMENT) where the sizes are not the raw material's.
BtfError measure_tables(const RawMaterial& raw, const nook::material::MaterialTables& tables);

// Seen from afar, where a pixel covers a square of texels: the mean of the raw radiances over it is the
// truth, beside the middle of the square at its mipmap level and at the finest one.
struct LevelError {
  std::uint32_t side = 0;  // texels
  double se_db = 0, se_db_finest = 0;
};
// Of the sides 2, 4, 8 and so on that divide the sides of the tile.
std::vector<LevelError> measure_levels(const RawMaterial& raw, const nook::material::MaterialTables& tables);

// Returns the bytes of all textures over the texels of the BTF.
double table_bytes_texel(const nook::material::MaterialTables& tables);

}  // namespace nook::bake::material
