// The visibility of seams in a plane that is put together from pieces of an exemplar.
#pragma once

#include <span>

#include "bakers/synthesis/exemplar.h"

namespace nook::bake::synthesis {

struct Seams {
  // The share of pairs of neighbours in the plane that are no neighbours in the exemplar.
  double jumps = 0;
  // The sum over those pairs of the squared difference of their looks beyond the mean one of neighbours in
  // the exemplar, for a texel of the plane; 0 where the exemplar goes on without a seam.
  double energy = 0;
};

// plane: side x side texels of the exemplar, row by row; the plane repeats.
Seams measure_seams(const Exemplar& exemplar, std::span<const Texel> plane, std::int32_t side);

// The same for the exemplar put beside itself.
Seams measure_tiled(const Exemplar& exemplar);

}  // namespace nook::bake::synthesis
