// Measures how visible seams are in a plane made of pieces of an exemplar.
#pragma once

#include <span>

#include "bakers/synthesis/exemplar.h"

namespace nook::bake::synthesis {

struct Seams {
  // The share of pairs of neighbours in the plane that are not neighbours in the exemplar.
  double jumps = 0;
  // For each such pair, takes the squared difference of their looks beyond the mean for neighbours in the
  // exemplar. The energy is their sum over the texels of the plane. It is 0 if the exemplar continues without
  // a seam.
  double energy = 0;
};

// plane: side x side texels of the exemplar, row by row; the plane repeats.
Seams measure_seams(const Exemplar& exemplar, std::span<const Texel> plane, std::int32_t side);

// The same for the exemplar put beside itself.
Seams measure_tiled(const Exemplar& exemplar);

}  // namespace nook::bake::synthesis
