#include "sdk/src/character/pose_record.h"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

#include "sdk/src/core/bytes.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"

namespace nook {
namespace {

constexpr std::string_view magic = "NOOKPOSE";
constexpr std::uint32_t record_version = 1;

void write_little(std::uint64_t value, int count, std::byte* out) {
  for (int i = 0; i < count; ++i) out[i] = std::byte(value >> (8 * i) & 255u);
}

struct Head {
  std::uint32_t bones = 0;
  std::uint64_t names_hash = 0;
};

// Throws Failure for a record that is cut off, before anything is allocated for it.
Head read_head(ByteReader& in, std::size_t record) {
  if (in.remaining() < pose_record_head || in.text(magic.size()) != magic)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "record %zu does not begin like a recorded pose; give the bytes that "
                  "nook_scene_record_pose wrote, one record after the other",
                  record);
  const std::uint32_t version = in.u32();
  if (version != record_version)
    throw Failure(NOOK_ERROR_FILE_VERSION,
                  "record %zu has the version %u (need %u); record the poses with this version of Nook",
                  record, version, record_version);
  Head head;
  head.bones = in.u32();
  head.names_hash = in.u64();
  if (head.bones > in.remaining() / pose_record_bone)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "record %zu is cut off (got %zu bytes for %u bones); the file was not written to its end",
                  record, in.remaining(), head.bones);
  return head;
}

std::vector<Mat3x4> read_bones(ByteReader& in, std::uint32_t count, std::size_t record) {
  std::vector<Mat3x4> bones(count);
  for (std::uint32_t b = 0; b < count; ++b) {
    for (float& element : bones[b].m) element = in.f32();
    if (!is_pose_matrix(bones[b]))
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "record %zu holds a matrix of bone %u that is not finite or far too large", record, b);
  }
  return bones;
}

}  // namespace

void write_pose_record(std::uint64_t names_hash, std::span<const Mat3x4> bones, std::span<std::byte> out) {
  std::memcpy(out.data(), magic.data(), magic.size());
  write_little(record_version, 4, &out[8]);
  write_little(bones.size(), 4, &out[12]);
  write_little(names_hash, 8, &out[16]);
  std::byte* at = out.data() + pose_record_head;
  for (const Mat3x4& bone : bones)
    for (const float element : bone.m) {
      write_little(bit_cast<std::uint32_t>(element), 4, at);
      at += 4;
    }
}

RecordedPoses read_pose_records(std::span<const std::byte> bytes, std::uint64_t names_hash,
                                std::size_t bones) {
  RecordedPoses out;
  ByteReader in(bytes, "poses");
  std::size_t record = 0;
  do {
    const Head head = read_head(in, record);
    std::vector<Mat3x4> pose = read_bones(in, head.bones, record++);
    if (head.names_hash == names_hash && head.bones == bones)
      out.poses.push_back(std::move(pose));
    else
      ++out.of_others;
  } while (in.remaining() > 0);
  return out;
}

}  // namespace nook
