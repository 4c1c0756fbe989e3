// A fit's solution as one matrix: where the Gram matrix is exact, coefficients are a linear function of what
// a fit gathers, so that any machine that multiplies can solve it.
#pragma once

#include "sdk/src/core/containers.h"
#include "sdk/src/probe/fit.h"
#include "sdk/src/probe/light_bands.h"

namespace nook::probe {

// basis.count rows of basis.count + band_functions columns. Row i gives coefficient i of the method `moments`
// from the integrals over the sphere of the light times each function, and then times each harmonic of bands
// 0 to 2; without the constraint the last columns are 0. Gaussians over the sphere only.
Vector<double> solution_map(const Basis& basis, Constraint constraint, Memory* memory = default_memory());

}  // namespace nook::probe
