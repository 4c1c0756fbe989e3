#include "bakers/measure/transfer/lit_material.h"

#include <vector>

#include "sdk/src/material/material_check.h"
#include "sdk/src/material/reflectance.h"

namespace nook::measure {

nook::transfer::Response response_of(const nook::material::MaterialTables& tables, std::uint32_t lobes) {
  nook::material::refuse_neural(tables.neural.is_used(), "radiance transfer");
  const nook::transfer::HemisphereCells cells(nook::transfer::sharpness_of(lobes), default_memory());
  const std::size_t count = std::size_t(3) * tables.btf.light_modes;
  std::vector<float> values(cells.direction.size() * count);
  for (std::size_t i = 0; i < cells.direction.size(); ++i)
    light_basis_at(tables, cells.direction[i], std::span(values).subspan(i * count, count));
  return make_response(
      lobes, cells,
      {values, tables.btf.light_modes, mean_reflectance(tables), tables.light_hash, tables.votf_hash},
      default_memory());
}

}  // namespace nook::measure
