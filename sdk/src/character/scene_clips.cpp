#include "sdk/src/character/scene_clips.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/character/bone_axes.h"
#include "sdk/src/character/gpu_pose.h"
#include "sdk/src/core/affine.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/prefetch.h"

namespace nook {
namespace {

Mat3x4 place_of(const nook_instance_clip& given) {
  Mat3x4 place;
  std::copy_n(given.place_3x4, 12, place.m);
  return place;
}

FrameMix mix_of(const ClipSet& set, const nook_instance_clip& given) {
  return frame_mix(set.clips[given.time.clip], given.time.seconds, given.time.wrap == NOOK_CLIP_LOOP);
}

PoseBound moved(const PoseBound& bound, const Mat3x4& place, float scale) {
  return {transform_point(place, bound.centre), scale * bound.radius, scale * bound.scale};
}

void check_time(const ClipSet& set, const nook_clip_time& time, std::size_t index) {
  if (time.clip >= set.clips.size())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "instances[%zu].time.clip is out of range (got %u, need less than %zu)", index, time.clip,
                  set.clips.size());
  if (time.wrap != NOOK_CLIP_CLAMP && time.wrap != NOOK_CLIP_LOOP)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "instances[%zu].time.wrap is unknown (got %d, need 0 or 1)",
                  index, time.wrap);
  if (!std::isfinite(time.seconds))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "instances[%zu].time.seconds is not finite (got %g)", index,
                  time.seconds);
}

void check_place(const nook_instance_clip& given, std::size_t index) {
  const Mat3x4 place = place_of(given);
  if (!is_pose_matrix(place))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "instances[%zu].place_3x4 is not finite or far too large",
                  index);
  const BoneAxes<float> axes = axes_of(place);
  if (!axes.is_even())
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "instances[%zu].place_3x4 is not a rotation with one scale (its axes have lengths %g %g %g, "
        "and the largest cosine between them is %g); call nook_scene_set_clip, which projects the "
        "bones",
        index, axes.length(0), axes.length(1), axes.length(2), axes.cosine());
}

bool is_within(const PoseBound& bound) {
  const auto is_near = [](float metres) { return std::abs(metres) <= max_pose_metres; };
  return is_near(bound.centre.x) && is_near(bound.centre.y) && is_near(bound.centre.z) &&
         is_near(bound.radius) && bound.scale <= max_pose_scale;
}

// First tests the precomputed bound of all frames, which is nearly always small enough.
void check_bound(const LoadedClips& clips, const nook_instance_clip& given, std::size_t index) {
  const Mat3x4 place = place_of(given);
  const float scale = std::sqrt(axes_of(place).longest_squared);
  const float reach = scale * clips.reach;
  const bool is_surely_within =
      std::max({std::abs(place.m[3]), std::abs(place.m[7]), std::abs(place.m[11])}) + reach <=
          max_pose_metres &&
      scale * clips.largest_scale <= max_pose_scale;
  if (is_surely_within || is_within(moved(bound_of_mix(clips, mix_of(clips.set, given)), place, scale)))
    return;
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                "the pose of instances[%zu] is far too large (clip %u at %g s, moved by its place)", index,
                given.time.clip, given.time.seconds);
}

void check_clip(Scene& scene, const LoadedClips& clips, const nook_instance_clip& given, std::size_t index) {
  if (given.reserved)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "instances[%zu].reserved is not 0 (got %u)", index,
                  given.reserved);
  check_time(clips.set, given.time, index);
  check_place(given, index);
  check_bound(clips, given, index);
  Instance& instance = instance_of(scene, given.instance);
  if (instance.model.get() != clips.model.get())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "instances[%zu] (instance %u) does not have the model that the clips were loaded for; make "
                  "a separate call for each model",
                  index, given.instance);
  if (instance.input.clip.call == scene.clip_calls)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "instances[%zu] (instance %u) occurs twice in a call", index,
                  given.instance);
  instance.input.clip.call = scene.clip_calls;
}

void take_clip(Scene& scene, const Ref<const LoadedClips>& clips, const nook_instance_clip& given) noexcept {
  Instance& instance = instance_of(scene, given.instance);
  InstanceInput& input = instance.input;
  leave_gpu_pose(scene, instance);
  if (input.clip.clips.get() != clips.get() || !input.clip.is_late) {
    ++scene.clips_revision;
    forget_uneven(instance);
    input.clip.clips = clips;
    input.clip.is_late = true;
  }
  input.clip.mix = mix_of(clips->set, given);
  input.clip.place = place_of(given);
  const PoseBound bound = moved(bound_of_mix(*clips, input.clip.mix), input.clip.place,
                                std::sqrt(axes_of(input.clip.place).longest_squared));
  input.bound = {bound.centre, bound.radius};
  input.scale = bound.scale;
  ++input.pose_revision;
}

// Prefetches an instance that is processed later. A crowd does not fit into the caches, so without
// prefetching, most of the time would be spent waiting for memory.
void fetch_ahead(const Scene& scene, std::span<const nook_instance_clip> given, std::size_t index) noexcept {
  constexpr std::size_t ahead = 8, line = 64;
  if (index + ahead >= given.size()) return;
  const std::size_t slot = (given[index + ahead].instance & max_slots) - std::size_t{1};
  if (slot >= scene.instances.size()) return;
  // set_clips accesses only the fields in front of `reported`.
  const Instance& instance = scene.instances[slot];
  const auto* const end = reinterpret_cast<const std::byte*>(&instance.input.reported);
  for (const auto* at = reinterpret_cast<const std::byte*>(&instance); at < end; at += line) prefetch(at);
}

}  // namespace

void set_clips(Scene& scene, const Ref<const LoadedClips>& clips, std::span<const nook_instance_clip> given) {
  ++scene.clip_calls;
  for (std::size_t i = 0; i < given.size(); ++i) {
    fetch_ahead(scene, given, i);
    check_clip(scene, *clips, given[i], i);
  }
  for (std::size_t i = 0; i < given.size(); ++i) {
    fetch_ahead(scene, given, i);
    take_clip(scene, clips, given[i]);
  }
}

void decode_late_bones(Instance& instance) noexcept {
  InstanceClip& clip = instance.input.clip;
  if (!clip.is_late) return;
  Vector<Mat3x4>& bones = instance.parts->bones;
  for (std::size_t b = 0; b < bones.size(); ++b)
    bones[b] = decode_bone(clip.clips->set, clip.mix, clip.place, b);
  clip.is_late = false;
}

Mat3x4 bone_of(const Instance& instance, std::size_t bone) noexcept {
  const InstanceClip& clip = instance.input.clip;
  return clip.is_late ? decode_bone(clip.clips->set, clip.mix, clip.place, bone) : instance.bones()[bone];
}

}  // namespace nook
