// Two groups of four floats in one AVX register. Include this file inside the namespace of an instruction
// set.

struct Eight {
  __m256 v;
  Eight() = default;
  Eight(__m256 a) : v(a) {}
  explicit Eight(float a) : v(_mm256_set1_ps(a)) {}
};

inline Eight load_eight(const float* p) {
  return _mm256_loadu_ps(p);
}
// Returns the same four floats twice.
inline Eight load_four_twice(const float* p) {
  const __m128 four = _mm_loadu_ps(p);
  return _mm256_insertf128_ps(_mm256_castps128_ps256(four), four, 1);
}
inline void store(float* p, Eight a) {
  _mm256_storeu_ps(p, a.v);
}
inline Eight operator*(Eight a, Eight b) {
  return _mm256_mul_ps(a.v, b.v);
}
// Returns a * b + c. The function is not named fma, because it would hide the fma of plain floats.
inline Eight product_plus(Eight a, Eight b, Eight c) {
  return _mm256_fmadd_ps(a.v, b.v, c.v);
}
