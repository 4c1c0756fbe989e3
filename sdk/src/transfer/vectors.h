// Vectors at vertices: light, visibility and a material's response together.
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

// Vertices first to first + count of baked transfer, whose lobes are those of the response. amplitudes has
// lobes x RGB; in the paper's form the light modes are the response's. The result does not depend on
// `parallel`. Nothing is allocated except for the padded amplitudes, and in the paper's form for the
// clusters' matrices under the light, from `memory`.
void baked_vectors(const Response& response, Isa isa, std::span<const float> amplitudes,
                   const Transfer& transfer, std::uint32_t first, std::uint32_t count,
                   const VectorOutput& output, const Parallel& parallel, Memory* memory);

// Vertices without visibility: all light above their horizon reaches them.
void open_vectors(const Response& response, Isa isa, std::span<const float> amplitudes,
                  std::span<const Frame> frames, const VectorOutput& output, const Parallel& parallel,
                  Memory* memory);

}  // namespace nook::transfer
