// Two groups of four floats for processors whose registers do not hold both. The file is included inside an
// instruction set's namespace, after its Four.

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
// Returns the product of the first two plus the third. A function named fma would hide the fma of plain
// floats.
inline Eight product_plus(Eight x, Eight y, Eight z) {
  return {x.a * y.a + z.a, x.b * y.b + z.b};
}
