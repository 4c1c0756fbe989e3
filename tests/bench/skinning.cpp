#include "tests/bench/skinning.h"

namespace nook::bench {

SkinningMatrix skinning_matrix(const Mat3x4& bone) {
  SkinningMatrix out{};
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 3; ++r) out.m[4 * c + r] = bone.m[4 * r + c];
  return out;
}

void skin_scalar(const SkinnedVertices& vertices, const SkinningMatrix* bones, float* posed) {
  for (std::uint32_t v = 0; v < vertices.count; ++v) {
    float m[16] = {};
    for (int b = 0; b < 4; ++b)
      for (int j = 0; j < 16; ++j) m[j] += vertices.weight[4 * v + b] * bones[vertices.bone[4 * v + b]].m[j];
    const float* p = vertices.rest + 6 * v;
    for (int r = 0; r < 3; ++r) {
      posed[6 * v + r] = m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r];
      posed[6 * v + 3 + r] = m[r] * p[3] + m[4 + r] * p[4] + m[8 + r] * p[5];
    }
  }
}

}  // namespace nook::bench
