// The weight of small details beside large forms.
#pragma once

#include "bakers/synthesis/exemplar.h"

namespace nook::bake::synthesis {

// Returns the exemplar with each channel divided by the root of its standard deviation, and the total
// variance kept. Principal components of a material with holes are the holes above all, and a synthesis that
// sees nothing else makes the rest flat.
Exemplar balanced(const Exemplar& exemplar);

}  // namespace nook::bake::synthesis
