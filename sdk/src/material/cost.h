// Estimates the cost of decoding a pixel from the sizes of the tables. A filtered fetch counts as one, and
// multiply-adds count single numbers.
#pragma once

#include "sdk/src/material/tables.h"

namespace nook::material {

struct DecodeCost {
  std::uint32_t fetches = 0;
  std::uint32_t multiply_adds = 0;
};

// Returns the fetches of spatial modes that each further place of a footprint adds. A mode in blocks takes
// two fetches.
inline std::uint32_t further_fetches(const TensorTables& t) {
  return t.terms * t.view_vec4_count * (t.light_modes + t.packed_modes);
}

// Returns the cost of a BTF's light modes or a VOTF's value. It counts the coefficients of each term, for
// three cells if cells blend, and the spatial mode of each coefficient and light mode. Several clusters add a
// fetch for the clusters of the terms. Without tables the cost is 0.
inline DecodeCost decode_cost(const TensorTables& t) {
  const std::uint32_t spatial = t.terms * t.view_vec4_count * t.light_modes;
  const std::uint32_t clusters = t.has_membership() ? vec4_count(t.memberships()) : 0;
  const std::uint32_t coefficients = t.terms * t.view_vec4_count;
  return {further_fetches(t) + (t.blended ? 3 : 1) * coefficients + clusters,
          4 * (spatial + (t.blended ? 3 * coefficients : 0))};
}

// Returns the cost of one light: three rows of the light basis.
inline DecodeCost light_cost(const TensorTables& btf) {
  return {3 * btf.light_modes / 4, 3 * btf.light_modes};
}

// Return the cost of a neural material's first layers, and of one light: the products of its matrices.
inline DecodeCost neural_decode_cost(const NeuralTables& t) {
  const NeuralShape& s = t.shape;
  return {(s.channels + s.offset_channels) / 4,
          (s.offset_channels + 4) * s.offset_units + s.offset_units + (s.channels + 4) * s.units};
}
inline DecodeCost neural_light_cost(const NeuralTables& t) {
  const NeuralShape& s = t.shape;
  return {0, neural_light_inputs * s.units + (s.layers - 1) * s.units * s.units + 3 * s.units};
}

// Returns the maximum cost of finding a point of the relief: a height and a place for each plane of the
// march.
inline DecodeCost relief_cost(const ReliefTables& relief) {
  if (!relief.moves()) return {};
  return {relief.steps ? relief.steps + 1 : 0, 2 * (relief.steps + 1)};
}

}  // namespace nook::material
