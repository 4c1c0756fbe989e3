// Two SIMD vectors as one number type. Each operation is applied to both vectors. While the processor waits
// for the result of one vector, it can work on the other one. V is the vector type of an instruction set,
// from the set's folder in sdk/src/isa.
#pragma once

namespace nook::simd {

template <class V>
struct Pair {
  V a, b;
  Pair() = default;
  Pair(V first, V second) : a(first), b(second) {}
  explicit Pair(V both) : a(both), b(both) {}
  explicit Pair(float both) : a(both), b(both) {}
};

template <class V>
Pair<V> operator+(Pair<V> x, Pair<V> y) {
  return {x.a + y.a, x.b + y.b};
}
template <class V>
Pair<V> operator-(Pair<V> x, Pair<V> y) {
  return {x.a - y.a, x.b - y.b};
}
template <class V>
Pair<V> operator*(Pair<V> x, Pair<V> y) {
  return {x.a * y.a, x.b * y.b};
}
template <class V>
Pair<V> operator/(Pair<V> x, Pair<V> y) {
  return {x.a / y.a, x.b / y.b};
}
template <class V>
Pair<V> fma(Pair<V> x, Pair<V> y, Pair<V> z) {
  return {fma(x.a, y.a, z.a), fma(x.b, y.b, z.b)};
}
template <class V>
Pair<V> min(Pair<V> x, Pair<V> y) {
  return {min(x.a, y.a), min(x.b, y.b)};
}
template <class V>
Pair<V> max(Pair<V> x, Pair<V> y) {
  return {max(x.a, y.a), max(x.b, y.b)};
}
template <class V>
Pair<V> sqrt_positive(Pair<V> x) {
  return {sqrt_positive(x.a), sqrt_positive(x.b)};
}
template <class V>
Pair<V> power_three_halves(Pair<V> x) {
  return {power_three_halves(x.a), power_three_halves(x.b)};
}
template <class V>
Pair<V> rsqrt(Pair<V> x) {
  return {rsqrt(x.a), rsqrt(x.b)};
}
template <class V>
Pair<V> rsqrt_cubed(Pair<V> x, float scale) {
  return {rsqrt_cubed(x.a, scale), rsqrt_cubed(x.b, scale)};
}
template <class V>
Pair<V> power(Pair<V> x, Pair<V> y) {
  return {power(x.a, y.a), power(x.b, y.b)};
}

}  // namespace nook::simd
