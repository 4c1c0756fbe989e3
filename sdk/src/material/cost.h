// Estimates the cost of decoding a pixel from the sizes of the tables. A filtered texture fetch counts as one
// fetch. Multiply-adds are counted per scalar, not per vector.
#pragma once

#include "sdk/src/material/tables.h"

namespace nook::material {

struct DecodeCost {
  std::uint32_t fetches = 0;
  std::uint32_t multiply_adds = 0;
};

// Returns the number of fetches of spatial modes that each additional place of a footprint needs. A mode that
// is stored in blocks takes two fetches.
inline std::uint32_t further_fetches(const TensorTables& t) {
  return t.terms * t.view_vec4_count * (t.light_modes + t.packed_modes);
}

// Returns the cost of decoding a BTF's light modes or a VOTF's value. Each term fetches its coefficients,
// three times if cells blend. Each coefficient needs the spatial modes of each light mode. If there are
// several clusters, the cluster indices of the terms must be fetched, too. If `t` is empty, the cost is 0.
inline DecodeCost decode_cost(const TensorTables& t) {
  const std::uint32_t spatial = t.terms * t.view_vec4_count * t.light_modes;
  const std::uint32_t clusters = t.has_membership() ? vec4_count(t.memberships()) : 0;
  const std::uint32_t coefficients = t.terms * t.view_vec4_count;
  return {further_fetches(t) + (t.blended ? 3 : 1) * coefficients + clusters,
          4 * (spatial + (t.blended ? 3 * coefficients : 0))};
}

// Returns the cost of one light, which reads three rows of the light basis.
inline DecodeCost light_cost(const TensorTables& btf) {
  return {3 * btf.light_modes / 4, 3 * btf.light_modes};
}

// neural_decode_cost returns the cost of a neural material's first layers, and neural_light_cost the cost of
// one light. The cost of one light is the number of products in the matrices that depend on the light.
inline DecodeCost neural_decode_cost(const NeuralTables& t) {
  const NeuralShape& s = t.shape;
  return {(s.channels + s.offset_channels) / 4,
          (s.offset_channels + 4) * s.offset_units + s.offset_units + (s.channels + 4) * s.units};
}
inline DecodeCost neural_light_cost(const NeuralTables& t) {
  const NeuralShape& s = t.shape;
  return {0, neural_light_inputs * s.units + (s.layers - 1) * s.units * s.units + 3 * s.units};
}

// Returns the maximum cost of finding the point of the relief that a view sees. For each plane, the march
// computes a place and fetches a height.
inline DecodeCost relief_cost(const ReliefTables& relief) {
  if (!relief.moves()) return {};
  return {relief.steps ? relief.steps + 1 : 0, 2 * (relief.steps + 1)};
}

}  // namespace nook::material
