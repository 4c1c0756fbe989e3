// A Dual stores a number and its derivatives with respect to the eight parameters of a capsule. The formulas
// of the runtime also work with this type, and then compute the derivatives too.
#pragma once

#include <array>
#include <cmath>

namespace nook::bake {

struct Dual {
  static constexpr int count = 8;
  float value = 0;
  std::array<float, count> slope{};

  Dual() = default;
  explicit Dual(float constant) : value(constant) {}
  static Dual parameter(float at, int index) {
    Dual d(at);
    d.slope[std::size_t(index)] = 1;
    return d;
  }
};

// Returns `value` with the slope first * a.slope + second * b.slope.
inline Dual combined(float value, float first, const Dual& a, float second, const Dual& b) {
  Dual r(value);
  for (std::size_t i = 0; i < Dual::count; ++i) r.slope[i] = first * a.slope[i] + second * b.slope[i];
  return r;
}
inline Dual scaled(float value, float first, const Dual& a) {
  Dual r(value);
  for (std::size_t i = 0; i < Dual::count; ++i) r.slope[i] = first * a.slope[i];
  return r;
}

inline Dual operator+(const Dual& a, const Dual& b) {
  return combined(a.value + b.value, 1, a, 1, b);
}
inline Dual operator-(const Dual& a, const Dual& b) {
  return combined(a.value - b.value, 1, a, -1, b);
}
inline Dual operator*(const Dual& a, const Dual& b) {
  return combined(a.value * b.value, b.value, a, a.value, b);
}
inline Dual operator/(const Dual& a, const Dual& b) {
  const float q = a.value / b.value;
  return combined(q, 1 / b.value, a, -q / b.value, b);
}
inline Dual fma(const Dual& a, const Dual& b, const Dual& c) {
  return a * b + c;
}
inline bool less(const Dual& a, const Dual& b) {
  return a.value < b.value;
}
inline Dual select(bool condition, const Dual& yes, const Dual& no) {
  return condition ? yes : no;
}
inline Dual min(const Dual& a, const Dual& b) {
  return a.value < b.value ? a : b;
}
inline Dual max(const Dual& a, const Dual& b) {
  return a.value > b.value ? a : b;
}
// At 0, the true slope is infinite. Returns a finite slope, so that its product with 0 is 0.
inline Dual sqrt(const Dual& a) {
  const float r = std::sqrt(a.value);
  return scaled(r, 0.5f / std::fmax(r, 1e-6f), a);
}
inline Dual rsqrt(const Dual& a) {
  const float r = 1 / std::sqrt(a.value);
  return scaled(r, -0.5f * r * r * r, a);
}

}  // namespace nook::bake
