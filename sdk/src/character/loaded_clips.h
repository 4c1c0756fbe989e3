// The clips that the runtime uses. They are shared and immutable. Their vertices and bones are in the order
// of the model.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/loaded_model.h"
#include "sdk/src/character/pose_bound.h"
#include "sdk/src/core/ref.h"
#include "shaders/core/texel_layout.h"

namespace nook {

// A point in time of a clip, as a mix of two frames of the set: (1 - share) * first + share * second.
struct FrameMix {
  std::uint32_t first = 0, second = 0;
  float share = 0;  // in [0, 1)
};

// Returns the frames of a clip at a time, which must be finite. A looping clip takes the time modulo its
// duration, so its last frame should equal its first. Otherwise the time is clamped to the clip.
FrameMix frame_mix(const ClipRange& clip, double time_s, bool is_looping) noexcept;

// The position and size of the body in a frame, in the clip's space.
struct FrameBound {
  PoseBound bound;
  // For each bone, take the centre of its bounding sphere (LoadedModel::BoneBound). In the middle between
  // this frame and the next, this centre is at most `swing` away from the mean of its positions in the two
  // frames. It does not move on a straight line, because the bone also turns between the frames.
  float swing = 0;  // metres
};

struct LoadedClips : RefCounted {
  // The set must have passed check_clip_set. Throws Failure(INVALID_ARGUMENT) if the set was baked for
  // another character.
  LoadedClips(ClipSet loaded, Ref<const LoadedModel> of, Memory* memory);

  const Ref<const LoadedModel> model;

  // The modes of AO in the slot order of the model's linear layer, in blocks of block_slots slots. A block
  // stores all its modes one after another, so decoding a block reads one contiguous range of memory.
  static constexpr std::uint32_t block_slots = LoadedModel::slot_chunk;
  const AlignedArray<std::int8_t> block_mode;

  const ClipSet set;  // without the modes of AO, which are stored above instead

  // The bound of each frame. With it, the CPU need not compute the bones of a crowd. The radius is infinite
  // if the values of a frame are too large for a pose.
  const Vector<FrameBound> frame_bound;
  // In all frames, the body is within this distance, in metres, of the origin of the clip's space.
  const float reach;
  const float largest_scale;  // the largest scale of the bones in all frames

  const std::int8_t* block_modes(std::uint32_t block) const {
    return block_mode.data() + std::size_t(block) * block_slots * set.ao.modes;
  }
};

// Mixes the weights of the AO table. `weights` has set.ao.modes entries.
void mix_ao_weights(const ClipSet& set, const FrameMix& mix, float* weights) noexcept;

// Decodes the AO of the slots [first_slot, first_slot + count), clamped to [0, 1]. All these slots must lie
// in one block.
void decode_ao(const LoadedClips& clips, const float* weights, std::uint32_t first_slot, std::uint32_t count,
               float* ao) noexcept;

// Returns the matrix of a bone in a mix of frames: `place` times the map from rest space to the clip's space.
// The matrix is projected to the nearest rotation with one scale. Neither allocates nor throws.
Mat3x4 decode_bone(const ClipSet& set, const FrameMix& mix, const Mat3x4& place, std::size_t bone) noexcept;

// Returns a bound of the pose in a mix of frames, in the clip's space. Takes constant time. Exactly on a
// frame, the result is the frame's own bound.
PoseBound bound_of_mix(const LoadedClips& clips, const FrameMix& mix) noexcept;

// The next functions write the tables of clips as texels of four components. shaders/clips/host.glsl reads
// the textures.

// The size of a 2D texture. The rows are stored one after another.
struct ClipTexels {
  static constexpr std::uint32_t width = NOOK_TEXEL_ROW;
  std::uint64_t texels = 0;
  std::uint32_t texel_bytes = 0;

  std::uint32_t height() const { return static_cast<std::uint32_t>((texels + width - 1) / width); }
  std::uint64_t bytes() const { return std::uint64_t(height()) * width * texel_bytes; }
};

ClipTexels mode_texels(const LoadedClips& clips);
ClipTexels weight_texels(const LoadedClips& clips);

// Both functions fill the bytes of the texture. The bytes after the last texel become 0.
void write_mode_texels(const LoadedClips& clips, void* texels) noexcept;
void write_weight_texels(const LoadedClips& clips, void* texels) noexcept;

}  // namespace nook
