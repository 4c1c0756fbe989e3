// Conversion of lobes between the C interface and the library.
#pragma once

#include <nook/nook.h>

#include "sdk/src/core/spherical_gaussian.h"

namespace nook::api {

inline nook_lobe to_public(const SphericalGaussian& lobe) {
  return {{lobe.axis.x, lobe.axis.y, lobe.axis.z},
          lobe.sharpness,
          {lobe.amplitude.x, lobe.amplitude.y, lobe.amplitude.z},
          0};
}

}  // namespace nook::api
