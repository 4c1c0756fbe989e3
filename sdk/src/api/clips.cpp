// Baked clips: loading, times, AO, poses and casters, and clips in scenes.
#include <nook/experimental/nook_clip_crowds.h>
#include <nook/experimental/nook_stages.h>
#include <nook/experimental/nook_world_sample.h>
#include <nook/nook_clips.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "sdk/src/api/clips_handle.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/pose_log.h"
#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/loaded_clips.h"
#include "sdk/src/character/pose_source.h"
#include "sdk/src/character/scene.h"
#include "sdk/src/character/scene_clips.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/core/geometry.h"

using namespace nook;

namespace {

FrameMix mix_of(const ClipSet& set, const nook_clip_time* time) {
  need(time, "time");
  check_index("time.clip", time->clip, set.clips.size());
  check_known("time.wrap", time->wrap, NOOK_CLIP_LOOP);
  if (!std::isfinite(time->seconds))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "time.seconds is not finite (got %g)", time->seconds);
  return frame_mix(set.clips[time->clip], time->seconds, time->wrap == NOOK_CLIP_LOOP);
}

Mat3x4 place_of(const float* place_3x4) {
  Mat3x4 place;
  if (!place_3x4) return place;
  std::copy_n(place_3x4, 12, place.m);
  if (!is_pose_matrix(place))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "place_3x4 is not finite or far too large");
  return place;
}

// Calls put(place, ao) for each file vertex. `place` is the address of the vertex in `out`.
template <class Put>
void write_ao(const LoadedClips& clips, const FrameMix& mix, void* out, std::size_t stride, Put&& put) {
  std::array<float, ClipSet::max_ao_modes> weights;
  mix_ao_weights(clips.set, mix, weights.data());
  std::array<float, LoadedClips::block_slots> ao;
  const LoadedModel& model = *clips.model;
  const std::uint32_t slots = model.linear.padded_slots();
  auto* const bytes = static_cast<unsigned char*>(out);
  for (std::uint32_t first = 0; first < slots; first += LoadedClips::block_slots) {
    const std::uint32_t count = std::min(LoadedClips::block_slots, slots - first);
    decode_ao(clips, weights.data(), first, count, ao.data());
    const std::uint32_t chunk = first / LoadedClips::block_slots;
    for (std::uint32_t r = model.run_begin[chunk]; r < model.run_begin[chunk + 1]; ++r) {
      const LoadedModel::FileRun& run = model.file_run[r];
      for (std::uint32_t i = 0; i < run.vertices; ++i)
        put(bytes + (run.first_vertex + i) * stride, ao[model.slot_in_chunk[run.first_entry + i]]);
    }
  }
}

void write_ao_as(const LoadedClips& clips, const FrameMix& mix, nook_format format, void* out,
                 std::size_t stride) {
  switch (format) {
    case NOOK_FORMAT_HALF:
      return write_ao(clips, mix, out, stride, [](unsigned char* place, float ao) {
        const std::uint16_t half = to_half(ao);
        std::memcpy(place, &half, sizeof half);
      });
    case NOOK_FORMAT_UNORM8:
      return write_ao(clips, mix, out, stride, [](unsigned char* place, float ao) {
        *place = static_cast<unsigned char>(ao * 255 + 0.5f);
      });
    default:
      return write_ao(clips, mix, out, stride,
                      [](unsigned char* place, float ao) { std::memcpy(place, &ao, sizeof ao); });
  }
}

// Returns the stride in bytes.
std::size_t check_ao_output(const LoadedClips& clips, nook_format format, std::uint32_t count,
                            std::size_t stride) {
  check_known("format", format, NOOK_FORMAT_UNORM8);
  const std::size_t vertices = clips.model->model.file_to_welded.size();
  if (count != vertices)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "count is not the model's file_vertex_count (got %u, need %zu)", count, vertices);
  return checked_stride("stride", stride, count, sizeof(float) >> format);
}

// Returns the pose of one bone, checked as nook_scene_set_pose checks it.
Mat3x4 checked_bone(const LoadedClips& clips, const FrameMix& mix, const Mat3x4& place, std::size_t bone) {
  const Mat3x4 matrix = decode_bone(clips.set, mix, place, bone);
  check_size(clips.model->model, bone, matrix);
  return matrix;
}

// Logs notes about place_3x4. The bones of a clip have a uniform scale and no shear, so there are no other
// notes.
void log_place(nook_clips_s& clips, const char* function, const Mat3x4& place) {
  const CharacterModel& model = clips.model->model;
  api::log_pose(*clips.context, function, model, notes_of_place(model, place), clips.reported);
}

nook_capsule capsule_of(const WorldCaster& caster, const Mat3x4& bone) {
  const float scale = caster.ao_scale * length({bone.m[0], bone.m[4], bone.m[8]});
  const Vec3 a = transform_point(bone, caster.capsule.a), b = transform_point(bone, caster.capsule.b);
  return {{a.x, a.y, a.z}, scale * caster.capsule.radius_a, {b.x, b.y, b.z}, scale * caster.capsule.radius_b};
}

ClipTexels texels_of(const LoadedClips& clips, nook_clips_table table) {
  check_known("table", table, NOOK_CLIPS_WEIGHTS);
  return table == NOOK_CLIPS_MODES ? mode_texels(clips) : weight_texels(clips);
}

}  // namespace

nook_result nook_clips_load(nook_context context, nook_model model, const void* bytes, size_t size,
                            nook_clips* out) {
  return api::enter("nook_clips_load", [&] {
    need(out, "out");
    *out = nullptr;
    need(context, "context");
    need(model, "model");
    need(bytes, "bytes");
    const auto read = [&](Memory* memory) {
      return read_clip_set({static_cast<const std::byte*>(bytes), size}, memory);
    };
    *out = Owned<nook_clips_s>::make(context->memory(), Ref<nook_context_s>::share(context), context,
                                     Ref<const LoadedModel>::share(model), read)
               .detach();
    const ClipSet& set = (*out)->set;
    context->log(NOOK_LOG_INFO, "clips: %zu clips, %u frames, %u vertices, %u modes, %zu bytes",
                 set.clips.size(), set.frame_count, set.ao.rows, set.ao.modes, size);
  });
}

void nook_clips_destroy(nook_clips* clips) {
  if (!clips || !*clips) return;
  (*clips)->release();
  *clips = nullptr;
}

nook_result nook_clips_describe(nook_clips clips, nook_clips_info* info) {
  return api::enter("nook_clips_describe", [&] {
    need(clips, "clips");
    const ClipSet& set = clips->set;
    nook_clips_info known{};
    known.clip_count = static_cast<std::uint32_t>(set.clips.size());
    known.frame_count = set.frame_count;
    known.mode_count = set.ao.modes;
    known.pose_mode_count = set.pose.modes;
    known.file_vertex_count = static_cast<std::uint32_t>(clips->model->model.file_to_welded.size());
    known.bone_count = static_cast<std::uint32_t>(set.bones.size());
    known.memory_bytes = sizeof *clips + clips->metered.bytes();
    write_info(info, known);
  });
}

nook_result nook_clips_describe_clip(nook_clips clips, uint32_t clip, nook_clip_info* info) {
  return api::enter("nook_clips_describe_clip", [&] {
    need(clips, "clips");
    const auto& known = clips->set.clips;
    check_index("clip", clip, known.size());
    nook_clip_info answer{};
    answer.first_frame = known[clip].first_frame;
    answer.frame_count = known[clip].frame_count;
    answer.duration_s = known[clip].duration_s;
    answer.name = known[clip].name.c_str();
    write_info(info, answer);
  });
}

nook_result nook_clips_frames(nook_clips clips, const nook_clip_time* time, uint32_t frames[2],
                              float* share) {
  return api::enter("nook_clips_frames", [&] {
    need(clips, "clips");
    const FrameMix mix = mix_of(clips->set, time);
    need(frames, "frames");
    need(share, "share");
    frames[0] = mix.first;
    frames[1] = mix.second;
    *share = mix.share;
  });
}

nook_result nook_clips_read_ao(nook_clips clips, const nook_clip_time* time, nook_format format, void* out,
                               uint32_t count, size_t stride) {
  return api::enter("nook_clips_read_ao", [&] {
    need(clips, "clips");
    const FrameMix mix = mix_of(clips->set, time);
    need(out, "out");
    stride = check_ao_output(*clips, format, count, stride);
    write_ao_as(*clips, mix, format, out, stride);
  });
}

nook_result nook_clips_read_pose(nook_clips clips, const nook_clip_time* time, const float* place_3x4,
                                 float* bones_3x4, uint32_t bone_count) {
  return api::enter("nook_clips_read_pose", [&] {
    need(clips, "clips");
    const FrameMix mix = mix_of(clips->set, time);
    const Mat3x4 place = place_of(place_3x4);
    need(bones_3x4, "bones_3x4");
    check_bone_count(bone_count, clips->set.bones.size());
    for (std::size_t b = 0; b < bone_count; ++b)
      std::copy_n(checked_bone(*clips, mix, place, b).m, 12, bones_3x4 + 12 * b);
    log_place(*clips, "nook_clips_read_pose", place);
  });
}

nook_result nook_clips_read_capsules(nook_clips clips, const nook_clip_time* time, const float* place_3x4,
                                     nook_capsule* out, uint32_t* count) {
  return api::enter("nook_clips_read_capsules", [&] {
    need(count, "count");
    const std::uint32_t room = *count;
    *count = 0;
    need(clips, "clips");
    const auto& casters = clips->model->model.world_casters;
    if (casters.empty())
      throw Failure(NOOK_ERROR_UNSUPPORTED, "the model was baked without world casters; bake it again");
    *count = static_cast<std::uint32_t>(casters.size());
    if (!out) return;
    if (room < casters.size())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "*count is too small (got %u, need %zu)", room,
                    casters.size());
    const FrameMix mix = mix_of(clips->set, time);
    const Mat3x4 place = place_of(place_3x4);
    for (std::size_t i = 0; i < casters.size(); ++i)
      out[i] = capsule_of(casters[i], checked_bone(*clips, mix, place, casters[i].bone));
    log_place(*clips, "nook_clips_read_capsules", place);
  });
}

nook_result nook_scene_set_clip(nook_scene scene, nook_instance_id instance, nook_clips clips,
                                const nook_clip_time* time, const float* place_3x4) {
  return api::enter("nook_scene_set_clip", [&] {
    need(scene, "scene");
    need(clips, "clips");
    const FrameMix mix = mix_of(clips->set, time);
    const PoseNotes notes =
        set_clip(scene->scene, instance, Ref<const LoadedClips>::share(clips), mix, place_of(place_3x4));
    api::log_pose(*scene->context, instance_of(scene->scene, instance), notes);
  });
}

nook_result nook_scene_set_clips(nook_scene scene, nook_clips clips, const nook_instance_clip* instances,
                                 uint32_t count) {
  return api::enter("nook_scene_set_clips", [&] {
    need(scene, "scene");
    need(clips, "clips");
    if (count == 0) return;
    need(instances, "instances");
    set_clips(scene->scene, Ref<const LoadedClips>::share(clips), {instances, count});
  });
}

nook_result nook_clips_read_table(nook_clips clips, nook_clips_table table, void* texels, size_t* size,
                                  uint32_t* width, uint32_t* height) {
  return api::enter("nook_clips_read_table", [&] {
    need(clips, "clips");
    need(size, "size");
    need(width, "width");
    need(height, "height");
    const ClipTexels known = texels_of(*clips, table);
    const std::size_t bytes = static_cast<std::size_t>(known.bytes());
    if (texels && *size < bytes)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "*size is too small (got %zu bytes, need %zu)", *size,
                    bytes);
    *size = bytes;
    *width = ClipTexels::width;
    *height = known.height();
    if (texels)
      table == NOOK_CLIPS_MODES ? write_mode_texels(*clips, texels) : write_weight_texels(*clips, texels);
  });
}
