// The clips of a character as two tables over frames. One table holds the character's own AO at each vertex,
// the other the pose of each bone. A table has a column for each frame. Each column is a weighted sum of a
// few modes, so a frame only stores a short row of weights. Everything is plain data, in rest space and
// metres.
#pragma once

#include <nook/nook.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sdk/src/character/model.h"
#include "sdk/src/core/container.h"
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
  std::uint32_t first_frame = 0;  // clips are stored one after another
  std::uint32_t frame_count = 0;  // at least 1
};

// A low-rank table of rows x frames. The value of row r in frame f is the sum over the modes k of
// frame_weight(f, k) * mode[k * rows + r] / max_mode.
template <class Number>
struct FrameTable {
  explicit FrameTable(Memory* memory = default_memory()) : mode(memory), weight(memory), scale(memory) {}

  // The largest magnitude of a stored mode element. The most negative integer is not used, so that both signs
  // have the same range.
  static constexpr int max_mode = (1 << (8 * sizeof(Number) - 1)) - 1;
  static constexpr int max_weight = 32767;

  std::uint32_t rows = 0;
  std::uint32_t modes = 0;
  Vector<Number> mode;          // modes x rows
  Vector<std::int16_t> weight;  // frames x modes
  Vector<float> scale;          // for each mode: the weight that the stored integer max_weight stands for

  float frame_weight(std::size_t frame, std::size_t k) const {
    return scale[k] * (1.0f / max_weight) * float(weight[frame * modes + k]);
  }
};

// The part of the body around a bone. The error of the bone's pose is measured by how far this part moves.
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
  // four, because shaders read four modes at a time.
  FrameTable<std::int8_t> ao;
  Vector<BoneSpan> bones;
  // For each bone, the map from rest space to the clip's space as 12 values: BoneSpan::radius times the nine
  // elements of rotation and scale, row by row, then the position of BoneSpan::centre. With this factor, an
  // error in any of the 12 values is a length in metres on the body.
  FrameTable<std::int16_t> pose;
  String recipe;  // JSON text of the bake's settings; the runtime does not read it
};

// Throws Failure with `code` and the first fault. A fault is a count or index out of range, an array of the
// wrong length, or a value that is not finite or not within its range.
void check_clip_set(const ClipSet& set, nook_result code);
// Checks only the counts. Call it before you read an array.
void check_clip_counts(const ClipSet& set, nook_result code);

// Returns a hash of the order of the model's welded vertices and bones. A ClipSet is only valid for this
// order. The hash stays the same if you bake the character again, or if you reorder the model to match a
// host's mesh.
std::uint64_t clip_model_hash(const CharacterModel& model);

// Throws Failure(INVALID_ARGUMENT) unless the set was baked from the model's character.
void check_clip_model(const ClipSet& set, const CharacterModel& model);

// Baked clips as .nook files. Version 1 of the kind "CLIP" has the sections
//   HEAD  u64 clip_model_hash; u32 frames, welded vertices; u16 modes of AO, modes of the pose
//   NAME  varint number of clips; for each: varint length and bytes of its name, f32 seconds, varint frames
//   AO    f32 scale of each mode; frames x modes i16 weights; modes x vertices i8
//   BONE  varint number of bones; for each: f32 centre x, y, z, radius
//   POSE  f32 scale of each mode; frames x modes i16 weights; modes x 12 bones i16
//   RECP  recipe
// The structs above document the values.

inline constexpr ContainerKind clip_kind{four_letters("CLIP"), "clips", 1, 1};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if check_clip_set finds a fault.
std::vector<std::byte> write_clip_set(const ClipSet& set);

// Safe for untrusted bytes, even if their checksum is correct. For an invalid file, the call throws
// Failure(NOOK_ERROR_BAD_FILE or NOOK_ERROR_FILE_VERSION). It allocates at most twice the file's size.
ClipSet read_clip_set(std::span<const std::byte> bytes, Memory* memory = default_memory());

}  // namespace nook
