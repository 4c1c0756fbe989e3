#include "bakers/job/pose_arrays.h"

#include <algorithm>

#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"

namespace nook::bake {

std::vector<Pose> read_poses(const float* bones_3x4, std::size_t poses, std::size_t bones) {
  std::vector<Pose> result(poses, Pose(bones));
  for (std::size_t p = 0; p < poses; ++p)
    for (std::size_t b = 0; b < bones; ++b) {
      const float* m = bones_3x4 + 12 * (p * bones + b);
      std::copy_n(m, 12, result[p][b].m);
      if (!is_pose_matrix(result[p][b]))
        throw Failure(
            NOOK_ERROR_INVALID_ARGUMENT,
            "the matrix of bone %zu in pose %zu is not finite or far too large; give 12 finite floats, "
            "places up to 1e9 m and scales up to 1e6",
            b, p);
    }
  return result;
}

void write_pose(const Pose& pose, float* bones_3x4) {
  for (const Mat3x4& bone : pose) bones_3x4 = std::copy_n(bone.m, 12, bones_3x4);
}

void write_points(std::span<const Vec3> welded, std::span<const std::uint32_t> file_to_welded, float* xyz) {
  for (std::uint32_t w : file_to_welded) {
    *xyz++ = welded[w].x;
    *xyz++ = welded[w].y;
    *xyz++ = welded[w].z;
  }
}

void need_count(const char* name, std::size_t got, std::size_t needed) {
  if (got != needed)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is wrong (got %zu, need %zu)", name, got, needed);
}

}  // namespace nook::bake
