#include "sdk/src/character/clip_set.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"
#include "sdk/src/core/hash.h"

namespace nook {
namespace {

constexpr std::uint32_t max_vertices = 1u << 24, max_bones = 65535;
constexpr float max_duration_s = 1e6f;
// The upper bound for the scale of an AO mode. AO is in [0, 1] and is a sum of products of modes and weights,
// so real scales are far below this bound.
constexpr float max_ao_scale = 1e4f;

void check_count(std::uint32_t got, std::uint32_t low, std::uint32_t high, const char* what,
                 nook_result code) {
  if (got < low || got > high)
    throw Failure(code, "the number of %s is out of range (got %u, need %u to %u); bake the clips again",
                  what, got, low, high);
}

void check_size(std::size_t got, std::uint64_t need, const char* what, nook_result code) {
  if (got != need)
    throw Failure(code, "the array of %s has the wrong length (got %zu, need %llu); bake the clips again",
                  what, got, static_cast<unsigned long long>(need));
}

template <class Number>
void check_table(const FrameTable<Number>& table, std::uint32_t frames, float max_scale, const char* what,
                 nook_result code) {
  check_size(table.mode.size(), std::uint64_t(table.modes) * table.rows, what, code);
  check_size(table.weight.size(), std::uint64_t(table.modes) * frames, what, code);
  check_size(table.scale.size(), table.modes, what, code);
  for (std::size_t k = 0; k < table.scale.size(); ++k)
    if (!(table.scale[k] >= 0) || !(table.scale[k] <= max_scale))
      throw Failure(code,
                    "the scale of mode %zu of the %s is out of range (got %g, need 0 to %g); bake the clips "
                    "again",
                    k, what, double(table.scale[k]), double(max_scale));
}

void check_clips(const ClipSet& set, nook_result code) {
  std::uint32_t frames = 0;
  for (std::size_t c = 0; c < set.clips.size(); ++c) {
    const ClipRange& clip = set.clips[c];
    if (!(clip.duration_s >= 0) || !(clip.duration_s <= max_duration_s))
      throw Failure(code,
                    "the duration of clip %zu is out of range (got %g, need 0 to %g seconds); bake the clips "
                    "again",
                    c, double(clip.duration_s), double(max_duration_s));
    if (clip.first_frame != frames || clip.frame_count < 1 || clip.frame_count > set.frame_count - frames)
      throw Failure(code,
                    "the frames of clip %zu are out of range (got %u frames, starting at frame %u; need at "
                    "least 1 frame, starting at frame %u, and the file has %u frames); bake the clips again",
                    c, clip.frame_count, clip.first_frame, frames, set.frame_count);
    frames += clip.frame_count;
  }
  if (frames != set.frame_count)
    throw Failure(
        code, "the frame counts of the clips do not add up to the total number of frames (got %u, need %u)",
        frames, set.frame_count);
}

}  // namespace

void check_clip_counts(const ClipSet& set, nook_result code) {
  check_count(set.frame_count, 1, ClipSet::max_frames, "frames", code);
  check_count(set.ao.rows, 1, max_vertices, "vertices", code);
  check_count(set.ao.modes, 4, ClipSet::max_ao_modes, "modes of AO", code);
  if (set.ao.modes % 4 != 0)
    throw Failure(code, "the number of AO modes is not a multiple of 4 (got %u); bake the clips again",
                  set.ao.modes);
  check_count(set.pose.modes, 1, ClipSet::max_pose_modes, "modes of the pose", code);
}

void check_clip_set(const ClipSet& set, nook_result code) {
  check_clip_counts(set, code);
  check_count(static_cast<std::uint32_t>(std::min<std::size_t>(set.clips.size(), UINT32_MAX)), 1,
              ClipSet::max_clips, "clips", code);
  check_count(static_cast<std::uint32_t>(std::min<std::size_t>(set.bones.size(), UINT32_MAX)), 1, max_bones,
              "bones", code);
  check_clips(set, code);
  check_size(set.pose.rows, std::uint64_t(pose_rows_per_bone) * set.bones.size(), "rows of the pose", code);
  check_table(set.ao, set.frame_count, max_ao_scale, "AO", code);
  check_table(set.pose, set.frame_count, max_metres, "pose", code);
  for (std::size_t b = 0; b < set.bones.size(); ++b) {
    const BoneSpan& bone = set.bones[b];
    if (!is_place(bone.centre) || !(bone.radius >= 1e-6f) || !(bone.radius <= max_metres))
      throw Failure(
          code, "the position or the radius of bone %zu is out of range (got %g %g %g with the radius %g)", b,
          double(bone.centre.x), double(bone.centre.y), double(bone.centre.z), double(bone.radius));
  }
}

namespace {

// Returns the index of the farthest vertex along each of several directions. If two models have the same
// welded vertices in a different order, these indices differ. The hash uses indices and not positions,
// because positions may differ in the last digit between machines.
std::array<std::uint32_t, 16> farthest_vertices(const CharacterModel& model) {
  std::array<std::uint32_t, 16> farthest{};
  for (std::size_t d = 0; d < farthest.size(); ++d) {
    // The directions lie on a spiral, which is not symmetric. So on a symmetric body, mirrored vertices are
    // not equally far along a direction.
    const double z = 1 - (2 * double(d) + 1) / double(farthest.size()), r = std::sqrt(1 - z * z),
                 turn = 2.399963229728653 * double(d) + 0.3;
    const double x = r * std::cos(turn), y = r * std::sin(turn);
    double most = -INFINITY;
    for (std::size_t i = 0; i < model.rest.position.size(); ++i) {
      const Vec3 p = model.rest.position[i];
      const double along = x * double(p.x) + y * double(p.y) + z * double(p.z);
      if (!(along > most)) continue;
      most = along;
      farthest[d] = static_cast<std::uint32_t>(i);
    }
  }
  return farthest;
}

}  // namespace

std::uint64_t clip_model_hash(const CharacterModel& model) {
  Hash64 hash;
  const auto add = [&](std::uint32_t number) {
    const std::byte bytes[4] = {std::byte(number), std::byte(number >> 8), std::byte(number >> 16),
                                std::byte(number >> 24)};
    hash.add(bytes);
  };
  add(static_cast<std::uint32_t>(model.vertex_count()));
  for (const std::uint32_t vertex : farthest_vertices(model)) add(vertex);
  for (const String& name : model.bone_names) {
    add(static_cast<std::uint32_t>(name.size()));
    hash.add({reinterpret_cast<const std::byte*>(name.data()), name.size()});
  }
  return hash.value();
}

void check_clip_model(const ClipSet& set, const CharacterModel& model) {
  if (set.ao.rows == model.vertex_count() && set.bones.size() == model.bone_count() &&
      set.model_hash == clip_model_hash(model))
    return;
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                "the clips were baked for another character than the model's (got %u vertices and %zu bones "
                "with the hash %016llx, need %zu and %zu with %016llx); bake the clips with this model",
                set.ao.rows, set.bones.size(), static_cast<unsigned long long>(set.model_hash),
                model.vertex_count(), model.bone_count(),
                static_cast<unsigned long long>(clip_model_hash(model)));
}

namespace {

// Returns the bits of a signed number as an unsigned number, which the file stores.
std::uint32_t unsigned_bits(std::int8_t value) {
  return static_cast<std::uint8_t>(value);
}
std::uint32_t unsigned_bits(std::int16_t value) {
  return static_cast<std::uint16_t>(value);
}

template <class Number>
std::vector<std::byte> bytes_of(const FrameTable<Number>& table) {
  ByteWriter out;
  for (const float scale : table.scale) out.f32(scale);
  for (const std::int16_t weight : table.weight) out.u16(unsigned_bits(weight));
  for (const Number number : table.mode)
    sizeof(Number) == 1 ? out.u8(unsigned_bits(number)) : out.u16(unsigned_bits(number));
  return out.bytes();
}

// Checks the section's size first, so that a bad count cannot allocate more than the section holds.
template <class Number>
void read_table(ByteReader in, std::uint32_t frames, FrameTable<Number>& table) {
  const std::uint64_t need = std::uint64_t(table.modes) * (4 + 2 * std::uint64_t(frames)) +
                             std::uint64_t(table.modes) * table.rows * sizeof(Number);
  if (in.remaining() != need)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "section %s has the wrong length (got %zu bytes, need %llu); bake the clips again",
                  in.name(), in.remaining(), static_cast<unsigned long long>(need));
  table.scale.resize(table.modes);
  for (float& scale : table.scale) scale = in.f32();
  table.weight.resize(std::size_t(frames) * table.modes);
  for (std::int16_t& weight : table.weight)
    weight = static_cast<std::int16_t>(static_cast<std::uint16_t>(in.u16()));
  table.mode.resize(std::size_t(table.modes) * table.rows);
  for (Number& number : table.mode)
    number = sizeof(Number) == 1 ? static_cast<Number>(static_cast<std::int8_t>(in.u8()))
                                 : static_cast<Number>(static_cast<std::int16_t>(in.u16()));
}

std::vector<std::byte> names_of(const ClipSet& set) {
  ByteWriter out;
  out.varint(static_cast<std::uint32_t>(set.clips.size()));
  for (const ClipRange& clip : set.clips) {
    out.varint(static_cast<std::uint32_t>(clip.name.size()));
    out.text(clip.name);
    out.f32(clip.duration_s);
    out.varint(clip.frame_count);
  }
  return out.bytes();
}

void read_names(ByteReader in, ClipSet& set) {
  // 48 bits: the shortest clip, which has an empty name, takes six bytes.
  const std::uint32_t count = in.check_count(in.varint(), 48, "clips");
  if (count > ClipSet::max_clips)
    throw Failure(NOOK_ERROR_BAD_FILE, "the number of clips is out of range (got %u, need 1 to %u)", count,
                  ClipSet::max_clips);
  set.clips.reserve(count);
  std::uint64_t frames = 0;
  for (std::uint32_t c = 0; c < count; ++c) {
    ClipRange& clip = set.clips.emplace_back();
    clip.name = in.text(in.varint());
    clip.duration_s = in.f32();
    clip.first_frame = static_cast<std::uint32_t>(frames);
    clip.frame_count = in.varint();
    frames += clip.frame_count;
    if (frames > set.frame_count)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "the clips have more frames than the file (got %llu frames in the clips up to clip %u, "
                    "need at most %u); bake the clips again",
                    static_cast<unsigned long long>(frames), c, set.frame_count);
  }
  in.check_end();
}

void read_bones(ByteReader in, ClipSet& set) {
  const std::uint32_t count = in.check_count(in.varint(), 128, "bones");
  set.bones.reserve(count);
  for (std::uint32_t b = 0; b < count; ++b) {
    BoneSpan& bone = set.bones.emplace_back();
    for (float* number : {&bone.centre.x, &bone.centre.y, &bone.centre.z, &bone.radius}) *number = in.f32();
  }
  in.check_end();
}

}  // namespace

std::vector<std::byte> write_clip_set(const ClipSet& set) {
  check_clip_set(set, NOOK_ERROR_INVALID_ARGUMENT);
  ByteWriter head, bones, recipe;
  head.u64(set.model_hash);
  head.u32(set.frame_count);
  head.u32(set.ao.rows);
  head.u16(set.ao.modes);
  head.u16(set.pose.modes);
  bones.varint(static_cast<std::uint32_t>(set.bones.size()));
  for (const BoneSpan& bone : set.bones)
    for (const float number : {bone.centre.x, bone.centre.y, bone.centre.z, bone.radius}) bones.f32(number);
  recipe.text(set.recipe);
  const ContainerSection sections[] = {
      {four_letters("HEAD"), head.bytes()},       {four_letters("NAME"), names_of(set)},
      {four_letters("AO  "), bytes_of(set.ao)},   {four_letters("BONE"), bones.bytes()},
      {four_letters("POSE"), bytes_of(set.pose)}, {four_letters("RECP"), recipe.bytes()}};
  return write_container(clip_kind, sections);
}

ClipSet read_clip_set(std::span<const std::byte> bytes, Memory* memory) {
  const Container file(bytes, clip_kind);
  ClipSet set(memory);
  ByteReader head = file.section("HEAD");
  set.model_hash = head.u64();
  set.frame_count = head.u32();
  set.ao.rows = head.u32();
  set.ao.modes = head.u16();
  set.pose.modes = head.u16();
  head.check_end();
  check_clip_counts(set, NOOK_ERROR_BAD_FILE);
  read_names(file.section("NAME"), set);
  read_bones(file.section("BONE"), set);
  set.pose.rows = pose_rows_per_bone * static_cast<std::uint32_t>(set.bones.size());
  read_table(file.section("AO  "), set.frame_count, set.ao);
  read_table(file.section("POSE"), set.frame_count, set.pose);
  ByteReader recipe = file.section("RECP");
  set.recipe = recipe.text(recipe.remaining());
  check_clip_set(set, NOOK_ERROR_BAD_FILE);
  return set;
}

}  // namespace nook
