// A vertex is 8 multiply-adds to blend two columns a register, then 6 to apply them. Stores overlap: each
// store writes four floats, and the next one overwrites the last of them.
#include <immintrin.h>

#include "sdk/src/core/isa.h"
#include "tests/bench/skinning.h"

namespace nook::bench {
namespace {

void skin(const SkinnedVertices& vertices, const SkinningMatrix* bones, float* posed) {
  const float* p = vertices.rest;
  const float* w = vertices.weight;
  const std::uint8_t* bone = vertices.bone;
  for (std::uint32_t v = 0; v < vertices.count; ++v, p += 6, w += 4, bone += 4, posed += 6) {
    const float* m0 = bones[bone[0]].m;
    const float* m1 = bones[bone[1]].m;
    const float* m2 = bones[bone[2]].m;
    const float* m3 = bones[bone[3]].m;
    const __m256 w0 = _mm256_broadcast_ss(w), w1 = _mm256_broadcast_ss(w + 1);
    const __m256 w2 = _mm256_broadcast_ss(w + 2), w3 = _mm256_broadcast_ss(w + 3);
    __m256 c01 = _mm256_mul_ps(w0, _mm256_load_ps(m0)), c23 = _mm256_mul_ps(w0, _mm256_load_ps(m0 + 8));
    c01 = _mm256_fmadd_ps(w1, _mm256_load_ps(m1), c01),
    c23 = _mm256_fmadd_ps(w1, _mm256_load_ps(m1 + 8), c23);
    c01 = _mm256_fmadd_ps(w2, _mm256_load_ps(m2), c01),
    c23 = _mm256_fmadd_ps(w2, _mm256_load_ps(m2 + 8), c23);
    c01 = _mm256_fmadd_ps(w3, _mm256_load_ps(m3), c01),
    c23 = _mm256_fmadd_ps(w3, _mm256_load_ps(m3 + 8), c23);
    const __m128 c0 = _mm256_castps256_ps128(c01), c1 = _mm256_extractf128_ps(c01, 1);
    const __m128 c2 = _mm256_castps256_ps128(c23), c3 = _mm256_extractf128_ps(c23, 1);
    const __m128 position = _mm_fmadd_ps(
        c0, _mm_broadcast_ss(p),
        _mm_fmadd_ps(c1, _mm_broadcast_ss(p + 1), _mm_fmadd_ps(c2, _mm_broadcast_ss(p + 2), c3)));
    const __m128 normal =
        _mm_fmadd_ps(c0, _mm_broadcast_ss(p + 3),
                     _mm_fmadd_ps(c1, _mm_broadcast_ss(p + 4), _mm_mul_ps(c2, _mm_broadcast_ss(p + 5))));
    _mm_storeu_ps(posed, position);
    _mm_storeu_ps(posed + 3, normal);
  }
}

}  // namespace

SkinFunction skin_avx2() {
  return processor_has_avx2_and_fma() ? skin : nullptr;
}

}  // namespace nook::bench
