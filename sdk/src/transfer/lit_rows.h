// The paper's form in a shape that a shader can mix. Under a light, every vertex is a sum of a few vectors
// times its own numbers. The vectors belong to the vertex's cluster and to reflected light; the numbers do
// not depend on the light.
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

// The vectors: vertex_rank for each cluster, then one for each reflection and band.
std::size_t lit_row_count(const Transfer& transfer);
// Writes lit_row_count vectors of 3 light_modes numbers. amplitudes has lobes x RGB.
void write_lit_rows(const Response& response, std::span<const float> amplitudes, const Transfer& transfer,
                    const Parallel& parallel, Memory* memory, std::span<float> rows);

// The numbers of a vertex: its cluster, vertex_rank weights, one weight for each reflection and band, and
// zeros up to a multiple of four.
std::size_t vertex_number_count(const Transfer& transfer);
void write_vertex_numbers(const Transfer& transfer, std::size_t vertex, float* numbers);

// The light that a baked shape reflects onto itself, as transfer.h has it.

// For each reflection b and band k, the radiance a^b L_k / pi. Entries beyond `bounces` are 0.
using ReflectedBands = std::array<Vec3, max_bounces * band_count>;

// amplitudes has lobes x RGB.
ReflectedBands reflected_light(const Response& response, std::span<const float> amplitudes,
                               std::uint32_t bounces, Memory* memory);

}  // namespace nook::transfer
