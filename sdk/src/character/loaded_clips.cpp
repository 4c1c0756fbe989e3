#include "sdk/src/character/loaded_clips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "sdk/src/character/bone_axes.h"
#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/pose_source.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/core/geometry.h"

namespace nook {
namespace {

ClipSet without_ao_modes(ClipSet set) {
  set.ao.mode.clear();
  set.ao.mode.shrink_to_fit();
  return set;
}

const ClipSet& checked(const ClipSet& set, const CharacterModel& model) {
  check_clip_model(set, model);
  return set;
}

AlignedArray<std::int8_t> in_blocks(const ClipSet& set, const LoadedModel& model, Memory* memory) {
  constexpr std::uint32_t block_slots = LoadedClips::block_slots;
  const std::uint32_t slots = model.linear.padded_slots(), blocks = (slots + block_slots - 1) / block_slots;
  AlignedArray<std::int8_t> out(std::size_t(blocks) * block_slots * set.ao.modes, memory);
  const auto& slot_of = model.linear.file_to_slot();
  for (std::size_t i = 0; i < slot_of.size(); ++i) {
    const std::uint32_t slot = slot_of[i], welded = model.model.file_to_welded[i];
    std::int8_t* const block = out.data() + std::size_t(slot / block_slots) * block_slots * set.ao.modes;
    for (std::size_t k = 0; k < set.ao.modes; ++k)
      block[k * block_slots + slot % block_slots] = set.ao.mode[k * set.ao.rows + welded];
  }
  return out;
}

// Returns the nearest matrix that has a uniform scale and no shear. The image of `centre` does not change.
// The polar factor is computed by Newton's iteration (Higham 1986, "Computing the Polar Decomposition",
// equation 3.3). A mix of two poses is close to its polar factor, so a few steps are enough. If the iteration
// does not converge, a slower method that always works is used.
Mat3x4 evened(const Mat3x4& matrix, Vec3 centre) {
  constexpr int max_steps = 12;
  constexpr float converged = 1e-6f;  // squared change in a step, for rows of unit length
  const float* const m = matrix.m;
  const Vec3 given[3] = {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}};
  const float mean =
      std::sqrt((dot(given[0], given[0]) + dot(given[1], given[1]) + dot(given[2], given[2])) / 3);
  if (!(mean > 1e-12f && mean < 1e12f))
    return to_float(projected(to_double(matrix), {centre.x, centre.y, centre.z}));
  Vec3 row[3] = {given[0] * (1 / mean), given[1] * (1 / mean), given[2] * (1 / mean)};
  float change = INFINITY;
  for (int step = 0; step < max_steps && change > converged; ++step) {
    const Vec3 cofactor[3] = {cross(row[1], row[2]), cross(row[2], row[0]), cross(row[0], row[1])};
    const float determinant = dot(row[0], cofactor[0]);
    if (!(std::abs(determinant) > 1e-4f)) break;
    change = 0;
    for (int i = 0; i < 3; ++i) {
      const Vec3 next = (row[i] + cofactor[i] * (1 / determinant)) * 0.5f;
      change = std::max(change, dot(next - row[i], next - row[i]));
      row[i] = next;
    }
  }
  if (!(change <= converged)) return to_float(projected(to_double(matrix), {centre.x, centre.y, centre.z}));
  const float scale = (dot(row[0], given[0]) + dot(row[1], given[1]) + dot(row[2], given[2])) / 3;
  const Vec3 image = transform_point(matrix, centre);
  Mat3x4 out{{scale * row[0].x, scale * row[0].y, scale * row[0].z, 0, scale * row[1].x, scale * row[1].y,
              scale * row[1].z, 0, scale * row[2].x, scale * row[2].y, scale * row[2].z, 0}};
  const Vec3 move = image - transform_vector(out, centre);
  out.m[3] = move.x;
  out.m[7] = move.y;
  out.m[11] = move.z;
  return out;
}

float mixed_weight(const FrameTable<std::int16_t>& table, const FrameMix& mix, std::size_t k) {
  const float first = table.frame_weight(mix.first, k);
  return first + mix.share * (table.frame_weight(mix.second, k) - first);
}

// Returns `time` modulo `duration`. `duration` must be a float value. Then its product with an integer below
// 2^21 is exact, and the difference equals the result of fmod. This is much faster than fmod.
double looped(double time, double duration) {
  const double turns = std::floor(time / duration);
  const double rest = time - turns * duration;
  if (std::abs(turns) < double(1 << 21) && rest >= 0 && rest < duration) return rest;
  const double left = std::fmod(time, duration);
  return left < 0 ? left + duration : left;
}

}  // namespace

FrameMix frame_mix(const ClipRange& clip, double time_s, bool is_looping) noexcept {
  const std::uint32_t last = clip.frame_count - 1;
  const double duration = double(clip.duration_s);
  FrameMix mix{clip.first_frame, clip.first_frame, 0};
  if (last == 0 || !(duration > 0)) return mix;
  double time = time_s;
  if (is_looping) time = looped(time, duration);
  const double place = std::clamp(time / duration, 0.0, 1.0) * last;
  const auto first = std::min(static_cast<std::uint32_t>(place), last - 1);
  mix.first += first;
  mix.second = mix.first + 1;
  mix.share = static_cast<float>(place - first);
  if (mix.share >= 1) mix = {mix.second, mix.second, 0};
  return mix;
}

void mix_ao_weights(const ClipSet& set, const FrameMix& mix, float* weights) noexcept {
  for (std::size_t k = 0; k < set.ao.modes; ++k) {
    const float first = set.ao.frame_weight(mix.first, k);
    weights[k] = first + mix.share * (set.ao.frame_weight(mix.second, k) - first);
  }
}

void decode_ao(const LoadedClips& clips, const float* weights, std::uint32_t first_slot, std::uint32_t count,
               float* ao) noexcept {
  constexpr std::uint32_t block_slots = LoadedClips::block_slots;
  const std::int8_t* mode = clips.block_modes(first_slot / block_slots) + first_slot % block_slots;
  std::fill_n(ao, count, 0.5f);
  for (std::uint32_t k = 0; k < clips.set.ao.modes; ++k, mode += block_slots) {
    const float weight = weights[k] * (1.0f / FrameTable<std::int8_t>::max_mode);
    for (std::uint32_t i = 0; i < count; ++i) ao[i] += weight * float(mode[i]);
  }
  for (std::uint32_t i = 0; i < count; ++i) ao[i] = std::min(std::max(ao[i], 0.0f), 1.0f);
}

namespace {

// Returns the weighted sum of the modes. This matrix may have shear and an uneven scale. It does not include
// the place of the instance.
Mat3x4 mixed_bone(const ClipSet& set, const FrameMix& mix, std::size_t bone) noexcept {
  constexpr float step = 1.0f / FrameTable<std::int16_t>::max_mode;
  std::array<float, pose_rows_per_bone> row{};
  const std::int16_t* mode = set.pose.mode.data() + bone * pose_rows_per_bone;
  for (std::uint32_t k = 0; k < set.pose.modes; ++k, mode += set.pose.rows) {
    const float weight = mixed_weight(set.pose, mix, k) * step;
    for (std::uint32_t i = 0; i < pose_rows_per_bone; ++i) row[i] += weight * float(mode[i]);
  }
  const BoneSpan& span = set.bones[bone];
  Mat3x4 matrix;
  for (std::uint32_t i = 0; i < 3; ++i)
    for (std::uint32_t j = 0; j < 3; ++j) matrix.m[4 * i + j] = row[3 * i + j] / span.radius;
  const Vec3 turned = transform_vector(matrix, span.centre);
  matrix.m[3] = row[9] - turned.x;
  matrix.m[7] = row[10] - turned.y;
  matrix.m[11] = row[11] - turned.z;
  return matrix;
}

// The bones of a frame. `mixed` holds the matrices as the table gives them. `even` holds the nearest matrices
// with a uniform scale and without shear.
struct FrameBones {
  explicit FrameBones(std::size_t count, Memory* memory) : mixed(memory), even(memory) {
    mixed.resize(count);
    even.resize(count);
  }
  Vector<Mat3x4> mixed, even;
};

PoseBound decode_frame(const ClipSet& set, const LoadedModel& model, std::uint32_t frame, FrameBones& out) {
  float longest_squared = 0;
  bool is_usable = true;
  for (std::size_t b = 0; b < out.even.size(); ++b) {
    out.mixed[b] = mixed_bone(set, {frame, frame, 0}, b);
    out.even[b] = evened(out.mixed[b], set.bones[b].centre);
    is_usable = is_usable && is_pose_matrix(out.even[b]);
    longest_squared = std::max(longest_squared, axes_of(out.even[b]).longest_squared);
  }
  if (!is_usable) return {{}, INFINITY, 1};
  return bound_of_bones(model, {out.even.data(), out.even.size()}, longest_squared);
}

float swing_of(const ClipSet& set, const LoadedModel& model, const FrameBones& from, const FrameBones& to) {
  float largest = 0;
  for (std::size_t b = 0; b < model.bone_bounds.size(); ++b) {
    const LoadedModel::BoneBound& bound = model.bone_bounds[b];
    if (bound.radius < 0) continue;
    Mat3x4 half;
    for (int i = 0; i < 12; ++i) half.m[i] = 0.5f * (from.mixed[b].m[i] + to.mixed[b].m[i]);
    const Vec3 at = transform_point(evened(half, set.bones[b].centre), bound.centre);
    const Vec3 mean =
        (transform_point(from.even[b], bound.centre) + transform_point(to.even[b], bound.centre)) * 0.5f;
    largest = std::max(largest, length(at - mean));
  }
  return largest;
}

Vector<FrameBound> make_frame_bounds(const ClipSet& set, const LoadedModel& model, Memory* memory) {
  Vector<FrameBound> out(memory);
  out.resize(set.frame_count);
  FrameBones earlier(set.bones.size(), memory), bones(set.bones.size(), memory);
  for (const ClipRange& clip : set.clips)
    for (std::uint32_t f = clip.first_frame; f < clip.first_frame + clip.frame_count; ++f) {
      std::swap(earlier, bones);
      out[f].bound = decode_frame(set, model, f, bones);
      if (f > clip.first_frame) out[f - 1].swing = swing_of(set, model, earlier, bones);
    }
  return out;
}

}  // namespace

Mat3x4 decode_bone(const ClipSet& set, const FrameMix& mix, const Mat3x4& place, std::size_t bone) noexcept {
  return place * evened(mixed_bone(set, mix, bone), set.bones[bone].centre);
}

// A linear mix of two rotation matrices shortens vectors. Let c be the cosine of half the angle between the
// two frames. At the share s of the second frame, the mix loses 1 - sqrt(1 - 4 s (1 - s) (1 - c^2)) of its
// length. This is at most 4 s (1 - s) (1 - c), and equals it at s = 1/2. The other parts of a bound are
// convex: for a mix of two frames, they are at most the mix of the two frames' bounds with the same share.
PoseBound bound_of_mix(const LoadedClips& clips, const FrameMix& mix) noexcept {
  const FrameBound &first = clips.frame_bound[mix.first], &second = clips.frame_bound[mix.second];
  const float s = mix.share;
  const auto mixed = [s](auto a, auto b) { return a + (b - a) * s; };
  return {mixed(first.bound.centre, second.bound.centre),
          mixed(first.bound.radius, second.bound.radius) + 4 * s * (1 - s) * first.swing,
          mixed(first.bound.scale, second.bound.scale)};
}

namespace {

template <class Measure>
float largest_of(const Vector<FrameBound>& frames, Measure&& measure) {
  float largest = 0;
  for (const FrameBound& frame : frames) largest = std::max(largest, measure(frame));
  return largest;
}

}  // namespace

LoadedClips::LoadedClips(ClipSet loaded, Ref<const LoadedModel> of, Memory* memory)
    : model(std::move(of)),
      block_mode(in_blocks(checked(loaded, model->model), *model, memory)),
      set(without_ao_modes(std::move(loaded))),
      frame_bound(make_frame_bounds(set, *model, memory)),
      reach(largest_of(frame_bound,
                       [](const FrameBound& frame) {
                         return length(frame.bound.centre) + frame.bound.radius + frame.swing;
                       })),
      largest_scale(largest_of(frame_bound, [](const FrameBound& frame) { return frame.bound.scale; })) {}

ClipTexels mode_texels(const LoadedClips& clips) {
  return {std::uint64_t(clips.model->model.file_to_welded.size()) * (clips.set.ao.modes / 4), 4};
}

ClipTexels weight_texels(const LoadedClips& clips) {
  return {std::uint64_t(clips.set.frame_count) * (clips.set.ao.modes / 4), 8};
}

void write_mode_texels(const LoadedClips& clips, void* texels) noexcept {
  constexpr std::uint32_t block_slots = LoadedClips::block_slots;
  const std::uint32_t modes = clips.set.ao.modes;
  auto* const out = static_cast<std::int8_t*>(texels);
  std::memset(out, 0, mode_texels(clips).bytes());
  const auto& slot_of = clips.model->linear.file_to_slot();
  for (std::size_t i = 0; i < slot_of.size(); ++i) {
    const std::int8_t* const block = clips.block_modes(slot_of[i] / block_slots) + slot_of[i] % block_slots;
    for (std::uint32_t k = 0; k < modes; ++k) out[i * modes + k] = block[std::size_t(k) * block_slots];
  }
}

void write_weight_texels(const LoadedClips& clips, void* texels) noexcept {
  const ClipSet& set = clips.set;
  auto* const out = static_cast<unsigned char*>(texels);
  std::memset(out, 0, weight_texels(clips).bytes());
  for (std::size_t f = 0; f < set.frame_count; ++f)
    for (std::size_t k = 0; k < set.ao.modes; ++k) {
      const std::uint16_t half = to_half(set.ao.frame_weight(f, k));
      std::memcpy(out + 2 * (f * set.ao.modes + k), &half, sizeof half);
    }
}

}  // namespace nook
