// Probes as the texels that shaders/probe/grid.glsl reads.
#pragma once

#include <cstdint>
#include <vector>

#include "sdk/src/core/containers.h"
#include "sdk/src/probe/probe.h"

namespace nook::gl {

// The texels, four floats each: counts and number of lobes; origin; 1 / spacing; axis and sharpness of each
// lobe; then the amplitudes of each probe, where x varies fastest, then y, then z.
std::uint64_t probe_texel_count(const probe::Probes& probes);
// The texel of a probe's first amplitude.
std::uint64_t first_amplitude_texel(std::uint32_t lobes, std::size_t probe);
Vector<float> probe_texels(const probe::Probes& probes, Memory* memory);

}  // namespace nook::gl
