// The light that a baked shape reflects onto itself, as transfer.h has it.
#pragma once

#include <array>
#include <span>

#include "sdk/src/transfer/light_bands.h"
#include "sdk/src/transfer/response.h"
#include "sdk/src/transfer/transfer.h"

namespace nook::transfer {

// For each reflection b and band k the radiance a^b L_k / pi; those beyond `bounces` are 0.
using ReflectedBands = std::array<Vec3, max_bounces * band_count>;

// amplitudes has lobes x RGB.
ReflectedBands reflected_light(const Response& response, std::span<const float> amplitudes,
                               std::uint32_t bounces, Memory* memory);

}  // namespace nook::transfer
