// Synthesises textures in appearance space (S. Lefebvre, H. Hoppe: Appearance-Space Texture Synthesis, 2006),
// with the coarse-to-fine scheme of their Parallel Controllable Texture Synthesis, 2005. Level by level,
// coordinates of the exemplar double in density, move at random and are corrected, all texels at once. A
// correction looks for a texel whose surroundings in the exemplar resemble its surroundings in the plane.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bakers/synthesis/exemplar.h"

namespace nook::bake::synthesis {

// Finds the second candidate of each texel for k-coherence (X. Tong and others: Synthesis of bidirectional
// texture functions on arbitrary surfaces, 2002).

// Return false to stop. Worker threads do not call it.
using Progress = std::function<bool(std::size_t done, std::size_t total)>;

// Returns for each texel the one with the most similar surroundings, which are the appearance vectors of its
// four diagonal neighbours at the spacing. Candidates are texels that a plane may show, at least a twentieth
// of the exemplar's shorter side away. An exemplar of more than 16,384 texels offers an evenly spread part of
// them.
std::vector<Texel> similar_texels(const tensor::Matrix& appearance, const ExemplarShape& shape,
                                  std::int32_t spacing);

inline constexpr std::uint32_t side_step = 64;  // a plane's side is a multiple of it
inline constexpr std::uint32_t min_exemplar_side = 16;

struct SynthesisSettings {
  std::uint32_t side = 512;  // texels per side of the plane
  // The random movement is from 0 to 1. It moves the first blocks relative to the exemplar, and texels at
  // each level but the two finest relative to their spacing.
  float jitter = 0.8f;
  std::uint32_t passes = 8;  // corrections at each level
  std::uint64_t seed = 1;
};

// Throws Failure(INVALID_ARGUMENT) that names the first fault.
void check_synthesis(const Exemplar& exemplar, const SynthesisSettings& settings);

// Returns side x side texels of the exemplar, row by row, for a plane that repeats. If the exemplar does not
// tile, two texels along its border are not shown, so that a filter of 3 x 3 texels never reaches beyond it.
// Any number of threads gives the same bits. Throws Failure: INVALID_ARGUMENT, CANCELLED.
std::vector<Texel> synthesise(const Exemplar& exemplar, const SynthesisSettings& settings,
                              const Progress& progress = {});

}  // namespace nook::bake::synthesis
