// A material as it is decoded, by the CPU and by the GPU alike: what the texture units read, in their order.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "sdk/src/core/parallel.h"
#include "sdk/src/material/material.h"

namespace nook::material {

// Four numbers of a texel hold four neighbours of a mode: of the view mode in spatial modes and coefficients,
// of the light mode in the light map.
constexpr std::uint32_t in_fours(std::uint32_t rank) {
  return (rank + 3) / 4;
}

// Half floats, but for the membership.
struct TensorTables {
  explicit TensorTables(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : spatial(memory), coefficients(memory), membership(memory) {}

  std::uint32_t width = 0, height = 0;  // of level 0
  std::uint32_t levels = 0;
  std::uint32_t light_modes = 0;  // of a BTF R_l, rounded up to a multiple of 4; of a VOTF 1
  std::uint32_t view_fours = 0;   // R_v / 4, rounded up
  std::uint32_t clusters = 0;
  std::uint32_t side = 0;   // cells of the view map
  std::uint32_t terms = 0;  // of a cell, see ViewCells

  // Level after level: layers x height x width x 4, at layer (c light_modes + a) view_fours + b / 4 and
  // number b % 4 the mode S_c[a, b] of spatial_modes.h, times a power of two for the whole tensor.
  std::pmr::vector<std::uint16_t> spatial;
  // terms x view_fours layers of side x side x 4.
  std::pmr::vector<std::uint16_t> coefficients;
  // terms in fours: layers of side x side x 4; empty where there is but one cluster.
  std::pmr::vector<std::uint16_t> membership;

  std::uint32_t layers() const { return clusters * light_modes * view_fours; }
  // Where a level begins in `spatial`.
  std::size_t level_offset(std::uint32_t level) const;
};

struct MaterialTables {
  explicit MaterialTables(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : btf(memory), votf(memory), light(memory) {}

  TensorTables btf;
  TensorTables votf;  // where visibility is not none
  VisibilityForm visibility = VisibilityForm::none;
  VisibilityMapping mapping;

  static constexpr std::uint32_t light_side = 64;
  // The light basis over the hemisphere, linear between the lights; beyond the outermost, theirs by the ratio
  // of cosines, down to 0 at the horizon: layers x side x side x 4 floats, at layer
  // channel light_modes / 4 + a / 4. Takes back the power of two of the BTF's spatial modes.
  std::pmr::vector<float> light;
};

inline constexpr std::uint32_t default_map_side = 256;

// A sound material's. map_side: cells of the view maps where the material has none of its own.
MaterialTables make_tables(const Material& material, const Parallel& parallel,
                           std::pmr::memory_resource* memory, std::uint32_t map_side = default_map_side);

// Of the numbers above.
std::uint64_t table_bytes(const MaterialTables& tables);

}  // namespace nook::material
