// Computes ray-traced irradiance with little noise, for pictures.
#pragma once

#include "bakers/lab/crowd/truth.h"

namespace crowd::lab {

// Traces rays like nook::lab::crowd::traced_irradiance. Also traces the same rays without bodies and ground.
// The ratio of both results is the open share of the light. Most of the noise cancels in this ratio. The
// function returns the ratio times the exact irradiance of an open surface (Heitz et al. 2018, Combining
// Analytic Direct Illumination and Stochastic Shadows).
nook::lab::crowd::TracedIrradiance smooth_irradiance(const nook::lab::crowd::PosedCrowd& crowd,
                                                     std::span<const std::uint32_t> receivers,
                                                     const nook::lab::crowd::FloorPatch& patch,
                                                     const nook_bake_environment& environment,
                                                     const nook::lab::crowd::TraceSettings& settings);

}  // namespace crowd::lab
