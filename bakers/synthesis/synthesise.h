// Appearance-space texture synthesis (S. Lefebvre, H. Hoppe: Appearance-Space Texture Synthesis, 2006), on
// the coarse-to-fine scheme of their Parallel Controllable Texture Synthesis, 2005: coordinates of the
// exemplar are doubled in density level by level, moved at random, and corrected, all texels at once, towards
// those whose surroundings in the exemplar are like their surroundings in the plane.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bakers/synthesis/exemplar.h"

namespace nook::bake::synthesis {

// The second candidate of each texel for k-coherence (X. Tong and others: Synthesis of bidirectional texture
// functions on arbitrary surfaces, 2002).

// Returns false to stop. Worker threads do not call it.
using Progress = std::function<bool(std::size_t done, std::size_t total)>;

// Returns for each texel the one whose surroundings, the appearance vectors of its four diagonal neighbours
// at the spacing, are the most like its own, among those that are at least a twentieth of the exemplar's
// shorter side away from it and that a plane may show. An exemplar of more than 16,384 texels offers a part
// of them, evenly spread.
std::vector<Texel> similar_texels(const tensor::Matrix& appearance, const ExemplarShape& shape,
                                  std::int32_t spacing);

inline constexpr std::uint32_t side_step = 64;  // a plane's side is a multiple of it
inline constexpr std::uint32_t min_exemplar_side = 16;

struct SynthesisSettings {
  std::uint32_t side = 512;  // texels along a side of the plane
  // Random movement, 0 to 1: of the first blocks relative to the exemplar, and at each level but the two
  // finest relative to the spacing of its texels.
  float jitter = 0.8f;
  std::uint32_t passes = 8;  // corrections at each level
  std::uint64_t seed = 1;
};

// Throws Failure(INVALID_ARGUMENT) that names the first fault.
void check_synthesis(const Exemplar& exemplar, const SynthesisSettings& settings);

// Returns side x side texels of the exemplar, row by row, of a plane that repeats. Two texels along the
// border of an exemplar that does not tile are not shown, so that a filter of 3 x 3 texels never reaches
// beyond it. Gives the same bits on any number of threads. Throws Failure: INVALID_ARGUMENT, CANCELLED.
std::vector<Texel> synthesise(const Exemplar& exemplar, const SynthesisSettings& settings,
                              const Progress& progress = {});

}  // namespace nook::bake::synthesis
