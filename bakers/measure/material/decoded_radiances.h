// The radiances of a decoded point of a material under the lights of a raw material.
#pragma once

#include <vector>

#include "bakers/material/raw_material.h"
#include "bakers/tensor/tensor.h"
#include "sdk/src/material/neural_tables.h"
#include "sdk/src/material/tables.h"

namespace nook::bake::material {

// The radiances under all lights, three numbers each. Of a tensor, decode_modes(span) writes the light modes,
// and `lights` are light_rows of table_error.h; of a network, decode_sums(span) writes the sums that all
// lights share, and `lights` is not read.
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
