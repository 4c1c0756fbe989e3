// Two groups of four floats, for processors whose registers cannot hold both. Include this file inside the
// namespace of an instruction set, after the definition of Four.

struct Eight {
  Four a, b;
  Eight() = default;
  Eight(Four first, Four second) : a(first), b(second) {}
  explicit Eight(float all) : a(all), b(all) {}
};

inline Eight load_eight(const float* p) {
  return {load_four(p), load_four(p + 4)};
}
// Returns the same four floats twice.
inline Eight load_four_twice(const float* p) {
  const Four four = load_four(p);
  return {four, four};
}
inline void store(float* p, Eight x) {
  store(p, x.a);
  store(p + 4, x.b);
}
inline Eight operator*(Eight x, Eight y) {
  return {x.a * y.a, x.b * y.b};
}
// Returns x * y + z. The function is not named fma, because it would hide the fma of plain floats.
inline Eight product_plus(Eight x, Eight y, Eight z) {
  return {x.a * y.a + z.a, x.b * y.b + z.b};
}
