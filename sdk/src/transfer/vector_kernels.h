// Computes the vectors of vertices (see transfer.h). There is a plain function for each instruction set. All
// arrays belong to the caller. The functions do not allocate, lock or throw.
#pragma once

#include <cstdint>

#include "sdk/src/core/isa.h"

namespace nook::transfer {

// A light, and the response of a material to it. `amplitudes` has `padded` lobes with red, green, blue and 0
// each, divided by 255.
struct LightView {
  const float* axis_x = nullptr;
  const float* axis_y = nullptr;
  const float* axis_z = nullptr;
  const float* amplitudes = nullptr;
  std::uint32_t lobes = 0, padded = 0;

  std::uint32_t side = 0;
  float scale = 0, centre = 0, lowest_z = 0;
  const std::uint16_t* row_begin = nullptr;
  const std::uint16_t* row_end = nullptr;
  const float* table = nullptr;  // side x side x 3 x lanes
  std::uint32_t light_modes = 0, lanes = 0;
};

// The maximum number of nodes along a side of a response.
inline constexpr std::uint32_t max_side = 48;

// The number of scratch floats for a block. They take 80 KiB, which fits on the stack of a host's thread.
inline constexpr std::uint32_t scratch_floats = 20 * 1024;
inline constexpr std::uint32_t max_block_vertices = 4;
static_assert(max_side * max_side * 4 * 2 <= scratch_floats);

// Returns how many vertices fit into the scratch memory for a response with this side: 4 with 642 lobes, 2
// with 700 lobes or more.
constexpr std::uint32_t block_vertices(std::uint32_t side) {
  const std::uint32_t fitting = scratch_floats / (side * side * 4);
  return fitting < max_block_vertices ? 2 : max_block_vertices;
}

// A block of up to block_vertices(side) vertices.
struct VertexBlock {
  const std::uint8_t* shares = nullptr;  // `lobes` bytes for each vertex; null: all are 255
  const float* frames = nullptr;         // 9 floats for each vertex: the axes x, y and z
  std::uint32_t count = 0;
  float* vectors = nullptr;  // 3 x light_modes floats for each vertex
  std::uint64_t stride = 0;  // floats from one vertex's vector to the next
  float* scratch = nullptr;  // scratch_floats floats, aligned to 64 bytes
};

struct VectorKernels {
  Isa isa = Isa::scalar;
  const char* name = nullptr;
  // Computes the vectors of a block. Each lobe adds its light, times its share, to the four nodes around its
  // position in the response's grid. The sums are then the weights of the table's rows. So a vertex needs
  // `lobes` updates of four nodes, and a single product with the table. The alternative, looking up every
  // lobe in the table, would need a product with four rows for each lobe.
  void (*vectors)(const LightView& light, const VertexBlock& block);
};

// Returns the function table of one instruction set, or NULL if the processor or the build does not support
// it.
const VectorKernels* vector_kernels(Isa isa);

}  // namespace nook::transfer

// Declares, for each instruction set, the function that returns its table. Each instruction set has its own
// translation unit. Use a table only if the processor has the instruction set.
#define NOOK_ISA_ENTRY(name, value, built, runs)     \
  namespace nook::isa_##name {                       \
    const transfer::VectorKernels& vector_kernels(); \
  }
#include "sdk/src/core/isa_list.inl"
