// The linear layer of a character model, in an order that is efficient on CPUs. The layer is divided into
// blocks of 16 vertices that share key points. Each block is a small dense matrix.
#pragma once

#include <cstdint>
#include <vector>

#include "sdk/src/character/model.h"
#include "sdk/src/character/shadow_kernels.h"
#include "sdk/src/core/aligned_array.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/core/memory.h"

namespace nook {

// The number of vertices in a window. A window is a range of vertices in the file's order. The number is a
// multiple of all block sizes. If the vertices of a window are consecutive in the file, their AO takes 4 KiB.
inline constexpr std::uint32_t linear_window_vertices = 1024;

// Returns all vertices in the order of their slots. All vertices of a block come from the same window of the
// file's order. A block starts with the first vertex of the window that is not in a block yet. Then the
// vertex that adds the fewest key points to the block is added to it, until the block is full. The model's
// influences must be valid.
Vector<std::uint32_t> linear_layer_order(const CharacterModel& model, std::uint32_t block_vertices,
                                         Memory* memory);

class LinearLayer {
 public:
  // Leaves out entries with alpha 0. Throws Failure if an influence is not a key point of the model, or if
  // the length of an array does not match the model's counts.
  explicit LinearLayer(const CharacterModel& model, Memory* memory = default_memory());

  const LinearView& view() const { return view_; }
  // Returns the maximum over vertices of the sum of absolute blend weights. This is the largest factor by
  // which an error at key points can grow.
  float max_blend_gain() const { return max_blend_gain_; }
  // Returns the length of the ao array that ShadowKernels::linear_layer fills.
  std::uint32_t padded_slots() const { return view_.block_count * linear_block_vertices; }
  // Returns the slot of each vertex, in the order of the file.
  const AlignedArray<std::uint32_t>& file_to_slot() const { return file_to_slot_; }

 private:
  AlignedArray<LinearBlock> blocks_;
  AlignedArray<std::uint32_t> key_points_;
  AlignedArray<std::int16_t> alpha_;
  AlignedArray<std::int16_t> blend_;
  AlignedArray<float> open_bias_;
  AlignedArray<std::uint32_t> file_to_slot_;
  LinearView view_;
  float max_blend_gain_ = 0;
};

}  // namespace nook
