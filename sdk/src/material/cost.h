// What decoding costs a pixel, counted from the tables' sizes. A filtered fetch counts as one; multiply-adds
// are those of numbers.
#pragma once

#include "sdk/src/material/tables.h"

namespace nook::material {

struct DecodeCost {
  std::uint32_t fetches = 0;
  std::uint32_t multiply_adds = 0;
};

// A BTF's light modes, or a VOTF's value: of each term its coefficients, of each coefficient and light mode
// the spatial mode, and the terms' clusters where there are several. No tables, no cost.
inline DecodeCost decode_cost(const TensorTables& t) {
  const std::uint32_t spatial = t.terms * t.view_fours * t.light_modes;
  const std::uint32_t clusters = t.clusters > 1 ? in_fours(t.terms) : 0;
  return {spatial + t.terms * t.view_fours + clusters, 4 * spatial};
}

// One light: three rows of the light basis.
inline DecodeCost light_cost(const TensorTables& btf) {
  return {3 * btf.light_modes / 4, 3 * btf.light_modes};
}

}  // namespace nook::material
