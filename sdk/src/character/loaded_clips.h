// Clips in the runtime: shared and immutable, in the orders of the model that they belong to.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/loaded_model.h"
#include "sdk/src/core/ref.h"
#include "shaders/core/texel_layout.h"

namespace nook {

// A time of a clip as two frames of the set: the value is (1 - share) * first + share * second.
struct FrameMix {
  std::uint32_t first = 0, second = 0;
  float share = 0;  // in [0, 1)
};

// The frames of a clip at a time. A looping clip takes the time modulo its duration, so that its last frame
// should be equal to its first; otherwise the time is clamped to the clip. The time must be finite.
FrameMix frame_mix(const ClipRange& clip, double time_s, bool is_looping) noexcept;

struct LoadedClips : RefCounted {
  // The set must have passed check_clip_set. Throws Failure(INVALID_ARGUMENT) if it is of another character
  // than the model.
  LoadedClips(ClipSet loaded, Ref<const LoadedModel> of, Memory* memory);

  const Ref<const LoadedModel> model;

  // The modes of AO in the order of the slots of the model's linear layer, in blocks of block_slots slots: a
  // block has all its modes one after another, so that a vertex block is decoded from one run of memory.
  static constexpr std::uint32_t block_slots = LoadedModel::slot_chunk;
  const AlignedArray<std::int8_t> block_mode;

  const ClipSet set;  // without the modes of AO, which are above

  const std::int8_t* block_modes(std::uint32_t block) const {
    return block_mode.data() + std::size_t(block) * block_slots * set.ao.modes;
  }
};

// Mixes the weights of AO; weights has set.ao.modes entries.
void mix_ao_weights(const ClipSet& set, const FrameMix& mix, float* weights) noexcept;

// The AO of the slots [first_slot, first_slot + count) that lie in one block, clamped to [0, 1].
void decode_ao(const LoadedClips& clips, const float* weights, std::uint32_t first_slot, std::uint32_t count,
               float* ao) noexcept;

// The matrix of a bone in a mix of frames, place * rest space to the clip's space: the nearest one of one
// rotation and scale. Neither allocates nor throws.
Mat3x4 decode_bone(const ClipSet& set, const FrameMix& mix, const Mat3x4& place, std::size_t bone) noexcept;

// The tables of clips as texels of four numbers each, for the textures that shaders/clips/host.glsl reads.

// A 2D texture whose rows follow one another.
struct ClipTexels {
  static constexpr std::uint32_t width = NOOK_TEXEL_ROW;
  std::uint64_t texels = 0;
  std::uint32_t texel_bytes = 0;

  std::uint32_t height() const { return static_cast<std::uint32_t>((texels + width - 1) / width); }
  std::uint64_t bytes() const { return std::uint64_t(height()) * width * texel_bytes; }
};

ClipTexels mode_texels(const LoadedClips& clips);
ClipTexels weight_texels(const LoadedClips& clips);

// Fill the bytes of the texture, with zeros behind the last texel.
void write_mode_texels(const LoadedClips& clips, void* texels) noexcept;
void write_weight_texels(const LoadedClips& clips, void* texels) noexcept;

}  // namespace nook
