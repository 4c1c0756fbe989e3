// The part of the compute tier that decodes the bones of clips.
#include <cstring>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/floats.h"
#include "sdk/src/gl/character/compute_tier.h"

namespace nook::gl {
namespace {

static_assert(NOOK_MAX_POSE_MODES == ClipSet::max_pose_modes);
static_assert(NOOK_CLIP_BONE_WORDS * 2 == pose_rows_per_bone);
static_assert(NOOK_RECORD_CLIPS_MASK << NOOK_RECORD_CLIPS_SHIFT ==
              (NOOK_RECORD_POSED - 1) - NOOK_RECORD_PLACE);

// Returns the pair with an index, two 16-bit integers in a word. The first integer is in the low bits.
std::uint32_t pair_of(const Vector<std::int16_t>& numbers, std::size_t pair) {
  const auto bits = [&](std::size_t i) {
    return i < numbers.size() ? std::uint32_t{static_cast<std::uint16_t>(numbers[i])} : 0u;
  };
  return bits(2 * pair) | bits(2 * pair + 1) << 16;
}

// The table of clips has the layout that clip_bones.comp reads: the scale of each mode, the span of each
// bone, the weights of each frame, and the modes.
std::uint32_t table_words(const PlacedClips& placed) {
  return placed.first_mode() + static_cast<std::uint32_t>(placed.clips->set.pose.mode.size() / 2);
}

std::uint32_t table_word(const PlacedClips& placed, std::uint32_t word) {
  const ClipSet& set = placed.clips->set;
  if (word >= placed.first_mode()) return pair_of(set.pose.mode, word - placed.first_mode());
  if (word >= placed.first_weight()) return pair_of(set.pose.weight, word - placed.first_weight());
  if (word < set.pose.modes) return bit_cast<std::uint32_t>(set.pose.scale[word]);
  const std::uint32_t number = word - set.pose.modes;
  const BoneSpan& span = set.bones[number / NOOK_CLIP_SPAN_WORDS];
  const float numbers[] = {span.centre.x, span.centre.y, span.centre.z, span.radius};
  return bit_cast<std::uint32_t>(numbers[number % NOOK_CLIP_SPAN_WORDS]);
}

PlacedClips* known_clips(List<PlacedClips>& all, const LoadedClips* clips) {
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

void PlacedClips::upload_piece(Device& device) {
  const TableShape shape{"nook: poses of clips", table_words(*this), sizeof(std::uint32_t)};
  is_uploaded =
      upload.send(device, table, shape, [&](std::uint32_t first, std::uint32_t count, std::byte* out) {
        for (std::uint32_t i = 0; i < count; ++i) {
          const std::uint32_t word = table_word(*this, first + i);
          std::memcpy(out + i * sizeof word, &word, sizeof word);
        }
      });
}

std::uint32_t PlacedClips::first_weight() const {
  return clips->set.pose.modes + NOOK_CLIP_SPAN_WORDS * static_cast<std::uint32_t>(clips->set.bones.size());
}

std::uint32_t PlacedClips::first_mode() const {
  return first_weight() + static_cast<std::uint32_t>((clips->set.pose.weight.size() + 1) / 2);
}

// Lists the clips that instances use, without their tables.
void ComputeScene::find_clips() {
  const bool same_instances = clips.empty() || clips_structure_ == scene->structure_revision;
  if (clips_revision_ == scene->clips_revision && same_instances) return;
  for (PlacedClips& known : clips) known.is_used = false;
  PlacedClips* last = nullptr;
  for (const Instance& instance : scene->instances) {
    const InstanceClip& clip = instance.input.clip;
    if (instance.id == 0 || !clip.is_used()) continue;
    if (!last || last->clips.get() != clip.clips.get()) last = known_clips(clips, clip.clips.get());
    if (!last && clip.is_late)
      last = &clips.emplace_back(clip.clips, free_number(clips, clip.clips->model.get()));
    if (last) last->is_used = true;
  }
  clips_revision_ = scene->clips_revision;
  clips_structure_ = scene->structure_revision;
}

void ComputeScene::place_clips(Device& device, const Budget& budget) {
  find_clips();
  drop_within(clips, budget, [](const PlacedClips& known) { return !known.is_used; });
  bool is_missing = false;
  for (PlacedClips& known : clips) {
    if (known.is_uploaded) continue;
    if (!is_missing) device.report_host_errors();
    is_missing = true;
    do known.upload_piece(device);
    while (!known.is_uploaded && budget.is_left());
    if (!budget.is_left()) break;
  }
  if (is_missing) device.check("uploading clips");
}

std::uint32_t ComputeScene::number_of_clips(const Instance& instance) const {
  const LoadedClips* const wanted = instance.input.clip.clips.get();
  for (const PlacedClips& known : clips)
    if (known.clips.get() == wanted) return known.is_uploaded ? known.number : 0;
  return 0;
}

void ComputeTier::decode_clips(const Update& update) const {
  const Functions& gl = device_.gl;
  write_bones(update, decode_clips_, &ComputeChunk::Frame::late, [&](const ComputeChunk& chunk) {
    for (const PlacedClips& clips : update.placed.clips) {
      if (!clips.is_uploaded || clips.clips->model.get() != chunk.model->model.get()) continue;
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
