// Four floats for the pose kernels on x86-64, with FMA if the instruction set has it. Include this file
// inside the namespace of an instruction set.

struct Four {
  __m128 v;
  Four() = default;
  Four(__m128 a) : v(a) {}
  explicit Four(float a) : v(_mm_set1_ps(a)) {}
};

inline Four load_four(const float* p) {
  return _mm_loadu_ps(p);
}
inline void store(float* p, Four a) {
  _mm_storeu_ps(p, a.v);
}
inline Four operator+(Four a, Four b) {
  return _mm_add_ps(a.v, b.v);
}
inline Four operator-(Four a, Four b) {
  return _mm_sub_ps(a.v, b.v);
}
inline Four operator*(Four a, Four b) {
  return _mm_mul_ps(a.v, b.v);
}
inline Four operator/(Four a, Four b) {
  return _mm_div_ps(a.v, b.v);
}
inline Four fma(Four a, Four b, Four c) {
#if defined(__FMA__) || defined(__AVX2__)  // MSVC does not define __FMA__; its option for AVX2 includes FMA
  return _mm_fmadd_ps(a.v, b.v, c.v);
#else
  return a * b + c;
#endif
}
inline Four max(Four a, Four b) {
  return _mm_max_ps(a.v, b.v);
}
inline Four sqrt(Four a) {
  return _mm_sqrt_ps(a.v);
}
inline void transpose(Four& a, Four& b, Four& c, Four& d) {
  _MM_TRANSPOSE4_PS(a.v, b.v, c.v, d.v);
}
