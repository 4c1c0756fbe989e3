#ifndef NOOK_PROBE_LOBE
#define NOOK_PROBE_LOBE
// Spherical Gaussians and their closed forms, as in sdk/src/core/spherical_gaussian.h. NookLobe has the
// layout of nook_lobe in std140 and std430.
struct NookLobe {
  vec3 axis;       // unit
  float sharpness; // >= 0; 0 is constant over the sphere
  vec3 amplitude;  // linear RGB
  float reserved;
};

// Returns 1 - dot(a, b) of unit vectors, without cancellation for nearly equal ones.
float nook_probe_apart(vec3 a, vec3 b) {
  vec3 d = a - b;
  return 0.5 * dot(d, d);
}

// Returns the radiance from the unit direction s.
vec3 nook_sg_lobe_radiance(NookLobe lobe, vec3 s) {
  return lobe.amplitude * exp(-lobe.sharpness * nook_probe_apart(lobe.axis, s));
}

// Integral over the sphere at amplitude 1: 2 pi (1 - e^(-2 sharpness)) / sharpness.
float nook_sg_integral(float sharpness) {
  float x = sharpness;
  // The series for where the difference would cancel.
  float share = x < 0.05 ? 2.0 - x * (2.0 - x * (1.3333333 - 0.6666667 * x)) : (1.0 - exp(-2.0 * x)) / x;
  return 6.2831853 * share;
}

// Integral of the product of two lobes at amplitudes 1, in the form that never overflows; apart is 1 - cosine
// between their axes.
float nook_sg_product_integral(float a, float b, float apart) {
  float sum = a + b;
  float sharpness = sqrt(max(sum * sum - 2.0 * a * b * apart, 0.0));
  float drop = sum > 0.0 ? -2.0 * a * b * apart / (sharpness + sum) : 0.0;
  return exp(drop) * nook_sg_integral(sharpness);
}
#endif
