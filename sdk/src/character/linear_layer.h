// The linear layer of a character model in the order the processor likes: blocks of 16 vertices that share
// key points, each a small dense matrix.
#pragma once

#include <cstdint>
#include <memory_resource>

#include "sdk/src/character/model.h"
#include "sdk/src/character/shadow_kernels.h"
#include "sdk/src/core/aligned_array.h"

namespace nook {

class LinearLayer {
 public:
  // Entries with alpha 0 are left out. Throws Failure when an influence is not a key point of the model or an
  // array has not the length that the model's counts ask for.
  explicit LinearLayer(const CharacterModel& model,
                       std::pmr::memory_resource* memory = std::pmr::get_default_resource());

  const LinearView& view() const { return view_; }
  // The largest sum of a vertex's blend weights without their signs: what an error at key points can grow to.
  float max_blend_gain() const { return max_blend_gain_; }
  // Length of the ao array that ShadowKernels::linear_layer fills.
  std::uint32_t padded_slots() const { return view_.block_count * linear_block_vertices; }
  // The indices that ShadowKernels::scatter needs to write welded vertices, or vertices in the file's order.
  const AlignedArray<std::uint32_t>& welded_to_slot() const { return welded_to_slot_; }
  const AlignedArray<std::uint32_t>& file_to_slot() const { return file_to_slot_; }

 private:
  AlignedArray<LinearBlock> blocks_;
  AlignedArray<std::uint16_t> key_point_;
  AlignedArray<float> alpha_;
  AlignedArray<float> blend_;
  AlignedArray<float> open_bias_;
  AlignedArray<std::uint32_t> welded_to_slot_;
  AlignedArray<std::uint32_t> file_to_slot_;
  LinearView view_;
  float max_blend_gain_ = 0;
};

}  // namespace nook
