// Measures a material in the form in which it is drawn, which is decoded from tables in textures. It is
// measured at the texel centres, for the views and lights of the raw material. The error includes the
// rounding of the tables, the view map and the light map.
#pragma once

#include <vector>

#include "bakers/material/btf_error.h"
#include "bakers/material/raw_material.h"
#include "bakers/tensor/tensor.h"
#include "sdk/src/material/neural_tables.h"
#include "sdk/src/material/tables.h"

namespace nook::bake::material {

// Returns the light basis for all lights and channels of the raw material. The matrix has 3 x lights rows and
// one column per light mode.
tensor::Matrix light_rows(const RawMaterial& raw, const nook::material::MaterialTables& tables);

// Throws Failure(INVALID_ARGUMENT) if the sizes differ from the raw material's.
BtfError measure_tables(const RawMaterial& raw, const nook::material::MaterialTables& tables);

// The error when the material is seen from far away, so that a pixel covers a square of texels. The reference
// is the mean of the raw radiances over the square. It is compared with the material at the centre of the
// square, once at the mipmap level that fits the square and once at the finest level.
struct LevelError {
  std::uint32_t side = 0;  // texels
  double se_db = 0, se_db_finest = 0;
};
// Measures squares with sides of 2, 4, 8, ... texels, as long as the side divides both sides of the tile.
std::vector<LevelError> measure_levels(const RawMaterial& raw, const nook::material::MaterialTables& tables);

// Returns the bytes of all textures divided by the number of texels of the BTF.
double table_bytes_texel(const nook::material::MaterialTables& tables);

// Returns the radiances under all lights, three values per light. For a tensor, decode_modes(span) must write
// the light modes, and `lights` must be the result of light_rows. For a network, decode_sums(span) must write
// the sums that all lights share, and `lights` is ignored.
template <class DecodeModes, class DecodeSums>
tensor::Matrix decoded_radiances(const RawMaterial& raw, const nook::material::MaterialTables& tables,
                                 const tensor::Matrix& lights, const DecodeModes& decode_modes,
                                 const DecodeSums& decode_sums) {
  using Eigen::Index;
  if (!tables.neural.is_used()) {
    std::vector<float> modes(tables.btf.light_modes);
    decode_modes(modes);
    return lights * Eigen::Map<const tensor::Matrix>(modes.data(), Index(modes.size()), 1);
  }
  tensor::Matrix out(Index(raw.light_rows()), 1);
  std::vector<float> sums(tables.neural.decoded_count());
  decode_sums(sums);
  for (std::size_t l = 0; l < raw.lights.size(); ++l) {
    const Vec3 radiance = nook::material::neural_radiance(tables.neural, sums, raw.lights[l]);
    out.block(Index(3 * l), 0, 3, 1) << radiance.x, radiance.y, radiance.z;
  }
  return out;
}

}  // namespace nook::bake::material
