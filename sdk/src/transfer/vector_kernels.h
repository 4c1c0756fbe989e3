// Computes vectors at vertices, with a plain function for each instruction set. All arrays belong to the
// caller; nothing allocates, locks or throws.
#pragma once

#include <cstdint>

#include "sdk/src/core/isa.h"

namespace nook::transfer {

// A light over a response. amplitudes has `padded` lobes of red, green, blue and 0, divided by 255.
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

// The largest number of nodes along a side of a response.
inline constexpr std::uint32_t max_side = 48;

// The floats of the scratch of a block, 80 KiB: a thread of a host has room for them on its stack.
inline constexpr std::uint32_t scratch_floats = 20 * 1024;
inline constexpr std::uint32_t max_block_vertices = 4;
static_assert(max_side * max_side * 4 * 2 <= scratch_floats);

// Returns how many vertices of a response's side fit into the scratch: 4 with 642 lobes, 2 with 700 and more.
constexpr std::uint32_t block_vertices(std::uint32_t side) {
  const std::uint32_t fitting = scratch_floats / (side * side * 4);
  return fitting < max_block_vertices ? 2 : max_block_vertices;
}

// Up to block_vertices(side) vertices.
struct VertexBlock {
  const std::uint8_t* shares = nullptr;  // of each vertex, `lobes` bytes; null: all 255
  const float* frames = nullptr;         // the axes x, y and z of each vertex, 9 floats
  std::uint32_t count = 0;
  float* vectors = nullptr;  // 3 x light_modes floats of each vertex
  std::uint64_t stride = 0;  // floats between the vectors of two vertices
  float* scratch = nullptr;  // scratch_floats, on a 64-byte boundary
};

struct VectorKernels {
  Isa isa = Isa::scalar;
  const char* name = nullptr;
  // Every lobe adds its light, times its share, to the four nodes around its place in the response's grid.
  // The sums then weight the table. So a vertex costs `lobes` mixes of four nodes and one product with the
  // table. Looking up every lobe would cost a product with four rows of the table for each.
  void (*vectors)(const LightView& light, const VertexBlock& block);
};

// Returns the table of one instruction set, or NULL if the processor or the build lacks it.
const VectorKernels* vector_kernels(Isa isa);

}  // namespace nook::transfer

// The table of each instruction set's translation unit. Use a table only on a processor that has the
// instruction set.
#define NOOK_ISA_ENTRY(name, value, built, runs)     \
  namespace nook::isa_##name {                       \
    const transfer::VectorKernels& vector_kernels(); \
  }
#include "sdk/src/core/isa_list.inl"
