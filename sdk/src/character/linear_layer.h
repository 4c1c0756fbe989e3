// The linear layer of a character model in an order that is efficient on processors: blocks of 16 vertices
// that share key points, each as a small dense matrix.
#pragma once

#include <cstdint>
#include <vector>

#include "sdk/src/character/model.h"
#include "sdk/src/character/shadow_kernels.h"
#include "sdk/src/core/aligned_array.h"
#include "sdk/src/core/containers.h"
#include "sdk/src/core/memory.h"

namespace nook {

// A multiple of all block sizes. Its AO lies in 4 KiB where the file has no other vertices between.
inline constexpr std::uint32_t linear_window_vertices = 1024;

// Returns all vertices in the order of their slots. Blocks are made of the vertices of one window of the
// file's order: the first that is left, then always the one that needs the fewest further key points. The
// model's influences must be valid.
Vector<std::uint32_t> linear_layer_order(const CharacterModel& model, std::uint32_t block_vertices,
                                         Memory* memory);

class LinearLayer {
 public:
  // Entries with alpha 0 are left out. Throws Failure if an influence is not a key point of the model, or if
  // the length of an array does not match the model's counts.
  explicit LinearLayer(const CharacterModel& model, Memory* memory = default_memory());

  const LinearView& view() const { return view_; }
  // Returns the maximum over vertices of the sum of absolute blend weights, which is the largest gain of an
  // error at key points.
  float max_blend_gain() const { return max_blend_gain_; }
  // Returns the length of the ao array that ShadowKernels::linear_layer fills.
  std::uint32_t padded_slots() const { return view_.block_count * linear_block_vertices; }
  // The slot of each vertex in the file's order.
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
