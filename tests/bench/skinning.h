// Linear-blend skinning of positions and normals, four influences: the yardstick of what animating a
// character costs anyway.
#pragma once

#include <cstdint>

#include "sdk/src/core/vec.h"

namespace nook::bench {

// 64-byte aligned, column-major: lanes 4 c + r hold row r of column c, lanes 4 c + 3 are zero. What a
// renderer that skins on the CPU would keep, because a column then multiplies one coordinate.
struct alignas(64) SkinningMatrix {
  float m[16];
};
SkinningMatrix skinning_matrix(const Mat3x4& bone);

// Rest vertices: position and normal in a row, six floats each; four bones and weights.
struct SkinnedVertices {
  const float* rest = nullptr;
  const std::uint8_t* bone = nullptr;
  const float* weight = nullptr;
  std::uint32_t count = 0;
};

// posed has six floats for each vertex and two floats of slack after the last. Normals are not renormalised,
// as is usual if a shader does it, which makes this baseline faster.
using SkinFunction = void (*)(const SkinnedVertices& vertices, const SkinningMatrix* bones, float* posed);
void skin_scalar(const SkinnedVertices& vertices, const SkinningMatrix* bones, float* posed);
SkinFunction skin_avx2();    // nullptr where the processor lacks it
SkinFunction skin_avx512();  // the same

}  // namespace nook::bench
