// The crowd under a light against path tracing: AO alone, AO times the probe, and the occlusion of each lobe.
#pragma once

#include <nook/experimental/nook_trace.h>

#include "bakers/measure/crowd/ao_comparison.h"

namespace nook::measure::crowd {

// A light as lobes and as the environment that the lobes stand for.
struct Light {
  std::span<const nook_lobe> lobes;
  nook_bake_environment environment;
  float mean_radiance = 0;  // of the environment, over all directions and channels
};

struct LightErrors {
  // Errors of the irradiance of all channels, in units of the environment's mean irradiance.
  std::vector<FormErrors> forms;
  double noise_floor_mse = 0;  // the reference's own error
};

LightErrors measure_light(const Subject& subject, const Light& light);

// The three forms and the reference. The floor is path traced in all four panels.
platform::Image light_sheet(const Subject& subject, const Light& light);

}  // namespace nook::measure::crowd
