// Targets of the VOTF's fit that count sides instead of sizes.
#pragma once

#include <span>
#include <vector>

namespace nook::bake::material {

// The decoder only sees on which side of the threshold a value lies, so that least squares wastes ranks on
// the sizes of values. Returns targets of the next fit: a decoded value on the right side by the margin is
// kept, up to 1.5 times the distance that it has to the threshold in `values`; every other one has to come as
// far beyond the margin as it fell short of it. The fit of these targets has fewer errors (the squared hinge
// of N. Srebro, J. Rennie, T. Jaakkola: Maximum-margin matrix factorization, 2004). The margin is 0.8 of the
// smallest distance to the threshold in `values`.
std::vector<float> margin_targets(std::span<const float> values, std::span<const float> decoded,
                                  float threshold);

}  // namespace nook::bake::material
