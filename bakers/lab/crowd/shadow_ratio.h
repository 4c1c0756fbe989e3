// Ray-traced irradiance with little noise, for pictures.
#pragma once

#include "bakers/lab/crowd/truth.h"

namespace crowd::lab {

// Traces as nook::lab::crowd::traced_irradiance does, and traces the same rays without bodies and ground as
// well. The ratio of the two is the open share of the light, in which most of the rays' noise cancels, and
// the exact irradiance of an open surface is multiplied by it (Heitz et al. 2018, Combining Analytic Direct
// Illumination and Stochastic Shadows).
nook::lab::crowd::TracedIrradiance smooth_irradiance(const nook::lab::crowd::PosedCrowd& crowd,
                                                     std::span<const std::uint32_t> receivers,
                                                     const nook::lab::crowd::FloorPatch& patch,
                                                     const nook_bake_environment& environment,
                                                     const nook::lab::crowd::TraceSettings& settings);

}  // namespace crowd::lab
