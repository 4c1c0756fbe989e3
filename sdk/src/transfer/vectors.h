// Computes vectors at vertices from light, visibility and a material's response.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/isa.h"
#include "sdk/src/core/parallel.h"
#include "sdk/src/transfer/response.h"
#include "sdk/src/transfer/transfer.h"

namespace nook::transfer {

struct VectorOutput {
  float* vectors = nullptr;  // 3 x light_modes floats of each vertex: red, then green, then blue modes
  std::uint64_t stride = 0;  // floats between the vectors of two vertices
};

// Computes the vertices first to first + count of baked transfer, which must have the response's lobes; in
// the paper's form, also its light modes. amplitudes has lobes x RGB. The result does not depend on
// `parallel`. From `memory` it allocates only the padded amplitudes and, in the paper's form, the clusters'
// matrices under the light.
void baked_vectors(const Response& response, Isa isa, std::span<const float> amplitudes,
                   const Transfer& transfer, std::uint32_t first, std::uint32_t count,
                   const VectorOutput& output, const Parallel& parallel, Memory* memory);

// Computes vertices without visibility: all light above their horizon reaches them.
void open_vectors(const Response& response, Isa isa, std::span<const float> amplitudes,
                  std::span<const Frame> frames, const VectorOutput& output, const Parallel& parallel,
                  Memory* memory);

}  // namespace nook::transfer
