// Conversion of lobes between the C interface and the library.
#pragma once

#include <nook/nook_probe.h>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/probe/evaluate.h"

namespace nook::api {

inline nook_probe_lobe to_public(const SphericalGaussian& lobe) {
  return {{lobe.axis.x, lobe.axis.y, lobe.axis.z},
          lobe.sharpness,
          {lobe.amplitude.x, lobe.amplitude.y, lobe.amplitude.z},
          0};
}

inline probe::IrradianceForm irradiance_form(nook_probe_irradiance_form form) {
  if (form < NOOK_PROBE_IRRADIANCE_FITTED || form > NOOK_PROBE_IRRADIANCE_BANDS)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "form is unknown (got %d, need 0 to %d)", form,
                  NOOK_PROBE_IRRADIANCE_BANDS);
  return static_cast<probe::IrradianceForm>(form);
}

}  // namespace nook::api
