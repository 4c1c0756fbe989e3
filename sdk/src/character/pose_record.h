// Poses that were recorded in a game, for `nook bake character --calibrate`. A file is a sequence of records,
// so a host can append records to it. A record holds one pose of one body:
//
//   offset  bytes  what
//   0       8      "NOOKPOSE"
//   8       4      version, 1
//   12      4      number of bones
//   16      8      XXH64 of the names of the bones, each followed by a zero byte
//   24      48 b   12 floats for each bone, rest space to world: three rows of rotation and scale | translation
//
// All numbers are little-endian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/hash.h"
#include "sdk/src/core/vec.h"

namespace nook {

inline constexpr std::size_t pose_record_head = 24, pose_record_bone = 48;
constexpr std::size_t pose_record_size(std::size_t bones) {
  return pose_record_head + bones * pose_record_bone;
}

// Returns the hash of the names for a record. The elements of `names` must have data() and size().
template <class Names>
std::uint64_t hash_of_bone_names(const Names& names) {
  Hash64 hash;
  constexpr std::byte end{0};
  for (const auto& name : names) {
    hash.add(std::as_bytes(std::span(name.data(), name.size())));
    hash.add({&end, 1});
  }
  return hash.value();
}

// `out` must have pose_record_size bytes.
void write_pose_record(std::uint64_t names_hash, std::span<const Mat3x4> bones, std::span<std::byte> out);

// Reads the poses of a file that belong to a body with these bones. If the file also contains poses of other
// bodies, the function only counts them, in of_others. Throws Failure(NOOK_ERROR_BAD_FILE) if the file has no
// records, if a record is cut off or has another version, or if a matrix is not finite or far too large.
struct RecordedPoses {
  std::vector<std::vector<Mat3x4>> poses;
  std::size_t of_others = 0;
};
RecordedPoses read_pose_records(std::span<const std::byte> bytes, std::uint64_t names_hash,
                                std::size_t bones);

}  // namespace nook
