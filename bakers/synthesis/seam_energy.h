// Measures how visible seams are in a plane made of pieces of an exemplar.
#pragma once

#include <span>

#include "bakers/synthesis/exemplar.h"

namespace nook::bake::synthesis {

struct Seams {
  // The share of neighbouring texels in the plane that are not neighbours in the exemplar.
  double jumps = 0;
  // The energy of such a pair is the squared difference of its looks, minus the mean of this difference for
  // neighbours in the exemplar. This field is the sum over all pairs, divided by the number of texels in the
  // plane. It is 0 if the plane has no seams.
  double energy = 0;
};

// `plane` contains side x side texels of the exemplar, row by row. The plane repeats.
Seams measure_seams(const Exemplar& exemplar, std::span<const Texel> plane, std::int32_t side);

// Measures the seams between copies of the exemplar that are placed side by side.
Seams measure_tiled(const Exemplar& exemplar);

}  // namespace nook::bake::synthesis
