// The part of the compute tier that decodes the bones of clips.
#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/gl/character/compute_tier.h"

namespace nook::gl {
namespace {

static_assert(NOOK_MAX_POSE_MODES == ClipSet::max_pose_modes);
static_assert(NOOK_CLIP_BONE_WORDS * 2 == pose_rows_per_bone);
static_assert(NOOK_RECORD_CLIPS_MASK << NOOK_RECORD_CLIPS_SHIFT ==
              (NOOK_RECORD_POSED - 1) - NOOK_RECORD_PLACE);

using Words = Vector<std::uint32_t>;

// Packs two 16-bit integers into each word, the first one into the low bits.
void append_pairs(Words& out, const Vector<std::int16_t>& numbers) {
  const auto bits = [&](std::size_t i) {
    return i < numbers.size() ? std::uint32_t{static_cast<std::uint16_t>(numbers[i])} : 0u;
  };
  for (std::size_t i = 0; i < numbers.size(); i += 2) out.push_back(bits(i) | bits(i + 1) << 16);
}

// Packs clips in the layout that clip_bones.comp reads: the scale of each mode, the span of each bone, the
// weights of each frame, and the modes.
Words pack_clips(const ClipSet& set, Memory* memory) {
  Words out(memory);
  out.reserve(set.pose.modes + NOOK_CLIP_SPAN_WORDS * set.bones.size() + (set.pose.weight.size() + 1) / 2 +
              set.pose.mode.size() / 2);
  for (const float scale : set.pose.scale) out.push_back(bit_cast<std::uint32_t>(scale));
  for (const BoneSpan& span : set.bones)
    for (const float number : {span.centre.x, span.centre.y, span.centre.z, span.radius})
      out.push_back(bit_cast<std::uint32_t>(number));
  append_pairs(out, set.pose.weight);
  append_pairs(out, set.pose.mode);
  return out;
}

PlacedClips* find_clips(List<PlacedClips>& all, const LoadedClips* clips) {
  for (PlacedClips& known : all)
    if (known.clips.get() == clips) return &known;
  return nullptr;
}

// Shaders identify clips by a number that is unique for their model. Returns the smallest free number. Throws
// Failure if all numbers are in use.
std::uint32_t free_number(const List<PlacedClips>& all, const LoadedModel* model) {
  const auto is_taken = [&](std::uint32_t number) {
    return std::any_of(all.begin(), all.end(), [&](const PlacedClips& known) {
      return known.number == number && known.clips->model.get() == model;
    });
  };
  std::uint32_t number = 1;
  while (is_taken(number)) ++number;
  if (number > NOOK_RECORD_CLIPS_MASK)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the instances of a model use more than %u nook_clips at once; bake clips of one character "
                  "into one file",
                  NOOK_RECORD_CLIPS_MASK);
  return number;
}

}  // namespace

PlacedClips::PlacedClips(Device& device, Ref<const LoadedClips> loaded, std::uint32_t number_in_model)
    : clips(std::move(loaded)),
      number(number_in_model),
      table(static_buffer(device, "nook: poses of clips", pack_clips(clips->set, device.memory))) {}

std::uint32_t PlacedClips::first_weight() const {
  return clips->set.pose.modes + NOOK_CLIP_SPAN_WORDS * static_cast<std::uint32_t>(clips->set.bones.size());
}

std::uint32_t PlacedClips::first_mode() const {
  return first_weight() + static_cast<std::uint32_t>((clips->set.pose.weight.size() + 1) / 2);
}

void ComputeScene::place_clips(Device& device) {
  const bool same_instances = clips.empty() || clips_structure_ == scene->structure_revision;
  if (clips_revision_ == scene->clips_revision && same_instances) return;
  for (PlacedClips& known : clips) known.is_used = false;
  PlacedClips* last = nullptr;
  for (const Instance& instance : scene->instances) {
    const InstanceClip& clip = instance.input.clip;
    if (instance.id == 0 || !clip.is_used()) continue;
    if (!last || last->clips.get() != clip.clips.get()) last = find_clips(clips, clip.clips.get());
    if (!last && clip.is_late) {
      device.report_host_errors();
      last = &clips.emplace_back(device, clip.clips, free_number(clips, clip.clips->model.get()));
      device.check("uploading clips");
    }
    if (last) last->is_used = true;
  }
  clips.remove_if([](const PlacedClips& known) { return !known.is_used; });
  clips_revision_ = scene->clips_revision;
  clips_structure_ = scene->structure_revision;
}

std::uint32_t ComputeScene::number_of_clips(const Instance& instance) const {
  const LoadedClips* const wanted = instance.input.clip.clips.get();
  for (const PlacedClips& known : clips)
    if (known.clips.get() == wanted) return known.number;
  return 0;
}

void ComputeTier::decode_clips(const Update& update) const {
  const Functions& gl = device_.gl;
  write_bones(update, decode_clips_, &ComputeChunk::Frame::late, [&](const ComputeChunk& chunk) {
    for (const PlacedClips& clips : update.placed.clips) {
      if (clips.clips->model.get() != chunk.model->model.get()) continue;
      bind_whole(gl, NOOK_BINDING_MODEL, clips.table);
      gl.Uniform1ui(NOOK_LOCATION_CLIP_NUMBER, clips.number);
      gl.Uniform1ui(NOOK_LOCATION_CLIP_BONE_COUNT, chunk.model->bones());
      gl.Uniform1ui(NOOK_LOCATION_CLIP_MODE_COUNT, clips.clips->set.pose.modes);
      gl.Uniform1ui(NOOK_LOCATION_CLIP_FIRST_WEIGHT, clips.first_weight());
      gl.Uniform1ui(NOOK_LOCATION_CLIP_FIRST_MODE, clips.first_mode());
      gl.DispatchCompute(chunk.frame.selected, 1, 1);
    }
  });
}

}  // namespace nook::gl
