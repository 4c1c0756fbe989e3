// Computes the vectors of vertices (see transfer.h) from light, visibility and a material's response.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/isa.h"
#include "sdk/src/core/parallel.h"
#include "sdk/src/transfer/response.h"
#include "sdk/src/transfer/transfer.h"

namespace nook::transfer {

struct VectorOutput {
  float* vectors = nullptr;  // 3 x light_modes floats for each vertex: red, then green, then blue modes
  std::uint64_t stride = 0;  // floats from one vertex's vector to the next
};

// Computes the vectors of `count` vertices of baked transfer, beginning at vertex `first`. The transfer must
// have the same lobes as the response; in the paper's form, also the same light modes. `amplitudes` has an
// RGB value for each lobe. The result does not depend on `parallel`. From `memory`, the function allocates
// only the padded amplitudes and, in the paper's form, the result of paper_light.
void baked_vectors(const Response& response, Isa isa, std::span<const float> amplitudes,
                   const Transfer& transfer, std::uint32_t first, std::uint32_t count,
                   const VectorOutput& output, const Parallel& parallel, Memory* memory);

// Computes the vectors of vertices without baked visibility: each vertex receives all light above its
// horizon.
void open_vectors(const Response& response, Isa isa, std::span<const float> amplitudes,
                  std::span<const Frame> frames, const VectorOutput& output, const Parallel& parallel,
                  Memory* memory);

}  // namespace nook::transfer
