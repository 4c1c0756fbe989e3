// Synthesises textures in appearance space (S. Lefebvre, H. Hoppe: Appearance-Space Texture Synthesis, 2006),
// from coarse to fine as in their Parallel Controllable Texture Synthesis, 2005. Each texel of the plane
// stores coordinates in the exemplar. Each level doubles the resolution of the coordinates, moves them at
// random, and corrects them in parallel. A correction looks for an exemplar texel whose surroundings resemble
// the surroundings in the plane.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bakers/synthesis/exemplar.h"

namespace nook::bake::synthesis {

// Finds a second candidate for each texel, for k-coherent search (X. Tong and others: Synthesis of
// bidirectional texture functions on arbitrary surfaces, 2002).

// Return false to stop. Worker threads never call the function.
using Progress = std::function<bool(std::size_t done, std::size_t total)>;

// For each texel, returns the texel with the most similar surroundings. The surroundings are the appearance
// vectors of the four diagonal neighbours, `spacing` texels away. The candidates are the texels that a plane
// may show, at a distance of at least a twentieth of the exemplar's shorter side. Exemplars of more than
// 16,384 texels use only an evenly spread part of their texels as candidates.
std::vector<Texel> similar_texels(const tensor::Matrix& appearance, const ExemplarShape& shape,
                                  std::int32_t spacing);

inline constexpr std::uint32_t side_step = 64;  // a plane's side is a multiple of this
inline constexpr std::uint32_t min_exemplar_side = 16;

struct SynthesisSettings {
  std::uint32_t side = 512;  // texels per side of the plane
  // The strength of the random movement, 0 to 1. It moves the initial blocks, relative to the exemplar's
  // size. It also moves the texels at each level except the two finest, relative to their spacing.
  float jitter = 0.8f;
  std::uint32_t passes = 8;  // number of times that each level is corrected
  std::uint64_t seed = 1;
};

// Throws Failure(INVALID_ARGUMENT) if the exemplar or a setting is invalid. The message names the first
// error.
void check_synthesis(const Exemplar& exemplar, const SynthesisSettings& settings);

// Returns a plane that repeats: side x side texels of the exemplar, row by row. If the exemplar does not
// tile, the plane does not show the two outermost texels along its border. So a filter of 3 x 3 texels never
// reads beyond the exemplar. The result has the same bits on any number of threads. Throws
// Failure(INVALID_ARGUMENT), or Failure(CANCELLED) if `progress` returns false.
std::vector<Texel> synthesise(const Exemplar& exemplar, const SynthesisSettings& settings,
                              const Progress& progress = {});

}  // namespace nook::bake::synthesis
