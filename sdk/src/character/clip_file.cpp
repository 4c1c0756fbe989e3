#include "sdk/src/character/clip_file.h"

#include "sdk/src/character/clip_set_check.h"
#include "sdk/src/core/failure.h"

namespace nook {
namespace {

// The number as the file has it, without its sign.
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

// Nothing is allocated for more than the section holds.
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
  // A clip without a name takes six bytes.
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
                    "the clips have more frames than the file (got %llu up to clip %u, need at most %u); "
                    "bake the clips again",
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
