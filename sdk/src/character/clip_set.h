// The clips of a character as tables over frames: its own AO at each vertex and the pose of each bone. Both
// are products of few modes, so that a frame is a short row of weights. Plain data, rest space and metres.
#pragma once

#include <cstdint>
#include <utility>

#include "sdk/src/core/containers.h"
#include "sdk/src/core/vec.h"

namespace nook {

// Frame i of a clip is its pose at duration_s * i / (frame_count - 1).
struct ClipRange {
  using allocator_type = Allocator<std::byte>;
  explicit ClipRange(const allocator_type& memory = {}) : name(memory) {}
  ClipRange(const ClipRange&) = default;
  ClipRange(ClipRange&&) = default;
  ClipRange(const ClipRange& other, const allocator_type& memory) : ClipRange(memory) { *this = other; }
  ClipRange(ClipRange&& other, const allocator_type& memory) : ClipRange(memory) { *this = std::move(other); }
  ClipRange& operator=(const ClipRange&) = default;
  ClipRange& operator=(ClipRange&&) = default;

  String name;
  float duration_s = 0;
  std::uint32_t first_frame = 0;  // the clips of a set follow each other
  std::uint32_t frame_count = 0;  // at least 1
};

// A table of rows x frames of low rank: the value of row r in frame f is the sum over the modes k of
// frame_weight(f, k) * mode[k * rows + r] / max_mode.
template <class Number>
struct FrameTable {
  explicit FrameTable(Memory* memory = default_memory()) : mode(memory), weight(memory), scale(memory) {}

  // The largest magnitude of a number; the one below it is not used, so that both signs have the same range.
  static constexpr int max_mode = (1 << (8 * sizeof(Number) - 1)) - 1;
  static constexpr int max_weight = 32767;

  std::uint32_t rows = 0;
  std::uint32_t modes = 0;
  Vector<Number> mode;          // modes x rows
  Vector<std::int16_t> weight;  // frames x modes
  Vector<float> scale;          // of each mode: the weight max_weight stands for it

  float frame_weight(std::size_t frame, std::size_t k) const {
    return scale[k] * (1.0f / max_weight) * float(weight[frame * modes + k]);
  }
};

// The part of the body round a bone, whose displacement is the error of its pose.
struct BoneSpan {
  Vec3 centre;       // rest space
  float radius = 0;  // metres, > 0
};
inline constexpr std::uint32_t pose_rows_per_bone = 12;

struct ClipSet {
  explicit ClipSet(Memory* memory = default_memory())
      : clips(memory), ao(memory), bones(memory), pose(memory), recipe(memory) {}

  static constexpr std::uint32_t max_clips = 4096, max_frames = 1u << 20, max_ao_modes = 256,
                                 max_pose_modes = 512;

  Vector<ClipRange> clips;
  std::uint32_t frame_count = 0;  // of all clips
  std::uint64_t model_hash = 0;   // clip_model_hash of the character
  // AO of welded vertices: 0.5 + the table's value, clamped to [0, 1]. The number of modes is a multiple of
  // four, which is how shaders read them.
  FrameTable<std::int8_t> ao;
  Vector<BoneSpan> bones;
  // For each bone, rest space to the clip's space: radius times the nine numbers of its rotation and scale,
  // row by row, then the place of its centre. All rows are in metres on the body.
  FrameTable<std::int16_t> pose;
  String recipe;  // JSON text of the bake's settings; the runtime does not read it
};

}  // namespace nook
