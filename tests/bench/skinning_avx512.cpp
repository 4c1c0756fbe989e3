// A vertex is 4 multiply-adds to blend the whole matrix in one register, then 6 to apply its columns. Stores
// overlap: each store writes four floats, and the next one overwrites the last of them.
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
    __m512 m = _mm512_mul_ps(_mm512_set1_ps(w[0]), _mm512_load_ps(bones[bone[0]].m));
    m = _mm512_fmadd_ps(_mm512_set1_ps(w[1]), _mm512_load_ps(bones[bone[1]].m), m);
    m = _mm512_fmadd_ps(_mm512_set1_ps(w[2]), _mm512_load_ps(bones[bone[2]].m), m);
    m = _mm512_fmadd_ps(_mm512_set1_ps(w[3]), _mm512_load_ps(bones[bone[3]].m), m);
    const __m128 c0 = _mm512_castps512_ps128(m), c1 = _mm512_extractf32x4_ps(m, 1);
    const __m128 c2 = _mm512_extractf32x4_ps(m, 2), c3 = _mm512_extractf32x4_ps(m, 3);
    const __m128 position = _mm_fmadd_ps(
        c0, _mm_set1_ps(p[0]), _mm_fmadd_ps(c1, _mm_set1_ps(p[1]), _mm_fmadd_ps(c2, _mm_set1_ps(p[2]), c3)));
    const __m128 normal = _mm_fmadd_ps(
        c0, _mm_set1_ps(p[3]), _mm_fmadd_ps(c1, _mm_set1_ps(p[4]), _mm_mul_ps(c2, _mm_set1_ps(p[5]))));
    _mm_storeu_ps(posed, position);
    _mm_storeu_ps(posed + 3, normal);
  }
}

}  // namespace

SkinFunction skin_avx512() {
  return processor_has_avx512f() ? skin : nullptr;
}

}  // namespace nook::bench
