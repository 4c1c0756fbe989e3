// What one sphere does to one key point: the solid-angle and visibility terms of the model, and the physical form factor for
// casters that were not part of the fit. Written once over a number type F (float, or a SIMD vector with the same operators
// and the functions sqrt, rsqrt, min, max, select), so that the scalar reference and every SIMD path share the formulas.
#pragma once

#include <cstdint>

namespace nook {

enum class KernelForm : std::uint8_t {
  paper = 0,  // Le et al. 2019, slide 18
  nook = 1,   // rational fall-off with the true power of distance
};

struct Kernel {
  KernelForm form = KernelForm::nook;
  float gamma = 1.5f;  // exponent of the norm over spheres, >= 1; slide 20
};

}  // namespace nook
