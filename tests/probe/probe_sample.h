// Small probes of every kind, for tests of files.
#pragma once

#include <vector>

#include "sdk/src/probe/probe.h"

namespace nook::test {

inline probe::Probes sample_probes(const probe::Basis& basis,
                                   std::array<std::uint32_t, 3> counts = {1, 1, 1}) {
  probe::Probes probes;
  probes.basis = basis;
  probes.grid.counts = counts;
  probes.grid.origin_ws = {1, -2, 0.5f};
  probes.grid.spacing_ws = {0.25f, 3, 2};
  for (std::size_t i = 0; i < probes.grid.size() * basis.count; ++i)
    probes.coefficients.push_back({float(i % 7), 0.25f * float(i % 5), 100.0f / float(i + 1)});
  probes.recipe = "{\"lobes\":3}";
  return probes;
}

// A grid whose first cell has a wall.
inline probe::Probes sample_walls() {
  probe::Probes probes = sample_probes(probe::harmonic_basis(2), {3, 2, 2});
  probes.walls.bias = 0.0625f;
  probes.walls.cell.resize(probes.grid.cells());
  probes.walls.cell[0].plane[0] = {{-1, 0, 0.5f}, 0.75f};
  probes.walls.cell[0].counts = {0x55, 0xaa, 0x55, 0xaa, 0x55, 0xaa, 0x55, 0xaa};
  return probes;
}

// Lobes with amplitudes for gloss.
inline probe::Probes sample_gloss() {
  probe::Probes probes = sample_probes(probe::vogel_basis(3), {2, 1, 1});
  for (std::size_t i = 0; i < probes.coefficients.size(); ++i)
    probes.gloss.push_back({0.5f * float(i), 3, 1.25f * float(i % 2)});
  return probes;
}

inline std::vector<probe::Probes> all_sample_probes() {
  using namespace probe;
  return {sample_probes(vogel_basis(3, true), {2, 1, 2}),
          sample_probes(vogel_basis(2, false, Domain::hemisphere, {0, 1, 0})),
          sample_probes(harmonic_basis(2), {1, 2, 1}),
          sample_probes(dice_basis()),
          sample_walls(),
          sample_gloss()};
}

}  // namespace nook::test
