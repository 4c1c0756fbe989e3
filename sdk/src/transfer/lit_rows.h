// The paper's form, arranged so that a shader can evaluate it. Under a given light, the vector of a vertex is
// a weighted sum of a few row vectors. The row vectors depend on the light. Some of them belong to the
// vertex's cluster, and the others to light that the shape reflects onto itself. The weights belong to the
// vertex and do not depend on the light.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/parallel.h"
#include "sdk/src/transfer/distant_light.h"
#include "sdk/src/transfer/response.h"
#include "sdk/src/transfer/transfer.h"

namespace nook::transfer {

// Returns the number of row vectors: vertex_rank for each cluster, then one for each reflection and band.
std::size_t lit_row_count(const Transfer& transfer);
// Writes lit_row_count row vectors with 3 light_modes values each. `amplitudes` has an RGB value for each
// lobe.
void write_lit_rows(const Response& response, std::span<const float> amplitudes, const Transfer& transfer,
                    const Parallel& parallel, Memory* memory, std::span<float> rows);

// Returns how many values a vertex has: its cluster, vertex_rank weights, one weight for each reflection and
// band, and zeros that pad to a multiple of four.
std::size_t vertex_number_count(const Transfer& transfer);
void write_vertex_numbers(const Transfer& transfer, std::size_t vertex, float* numbers);

// The light that a baked shape reflects onto itself; see transfer.h.

// The radiance a^b L_k / pi for each reflection b and band k. Entries beyond `bounces` are 0.
using ReflectedBands = std::array<Vec3, max_bounces * band_count>;

// amplitudes has lobes x RGB.
ReflectedBands reflected_light(const Response& response, std::span<const float> amplitudes,
                               std::uint32_t bounces, Memory* memory);

}  // namespace nook::transfer
