#include "bakers/import/posed_normals.h"

#include <algorithm>

#include "sdk/src/core/affine.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

bool mirrors(const Mat3x4& matrix) {
  return determinant(to_double(matrix)) < 0;
}

Mat3x4 blended(const SkinWeights& weights, const Pose& pose) {
  Mat3x4 out{};
  for (int i = 0; i < 12; ++i) out.m[i] = 0;
  for (int k = 0; k < SkinWeights::max_bones && weights.weight[k] > 0; ++k)
    for (int i = 0; i < 12; ++i) out.m[i] += weights.weight[k] * pose[weights.bone[k]].m[i];
  return out;
}

}  // namespace

std::span<const std::array<std::uint32_t, 3>> posed_triangles(
    const SkinnedMesh& mesh, const Pose& pose, std::vector<std::array<std::uint32_t, 3>>& storage) {
  if (pose.size() != mesh.bones.size())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the number of bone matrices is wrong (got %zu, need %zu)",
                  pose.size(), mesh.bones.size());
  if (std::none_of(pose.begin(), pose.end(), mirrors)) return mesh.triangle;
  std::vector<std::uint8_t> is_mirrored;
  for (const SkinWeights& weights : mesh.weights) is_mirrored.push_back(mirrors(blended(weights, pose)));
  storage.clear();
  for (const auto& t : mesh.triangle) {
    const int count = is_mirrored[t[0]] + is_mirrored[t[1]] + is_mirrored[t[2]];
    if (count == 0) storage.push_back(t);
    if (count == 3) storage.push_back({t[0], t[2], t[1]});
  }
  return storage;
}

void posed_normals(const SkinnedMesh& mesh, const Pose& pose, std::span<const Vec3> positions,
                   std::vector<Vec3>& out) {
  std::vector<std::array<std::uint32_t, 3>> storage;
  vertex_normals(posed_triangles(mesh, pose, storage), positions, out);
}

}  // namespace nook::bake
