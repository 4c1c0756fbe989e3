#ifndef NOOK_PROBE_LOBE
#define NOOK_PROBE_LOBE
// Spherical Gaussians (lobes) and integrals of them in closed form. sdk/src/core/spherical_gaussian.h has the
// same functions. In std140 and std430, NookLobe has the layout of nook_lobe.
struct NookLobe {
  vec3 axis;       // unit
  float sharpness; // >= 0; 0 is constant over the sphere
  vec3 amplitude;  // linear RGB
  float reserved;
};

// Returns 1 - dot(a, b) for unit vectors. The result is accurate even if the vectors are nearly equal.
float nook_probe_apart(vec3 a, vec3 b) {
  vec3 d = a - b;
  return 0.5 * dot(d, d);
}

// Returns the radiance from the unit direction s.
vec3 nook_sg_lobe_radiance(NookLobe lobe, vec3 s) {
  return lobe.amplitude * exp(-lobe.sharpness * nook_probe_apart(lobe.axis, s));
}

// Returns the integral over the sphere of a lobe with amplitude 1: 2 pi (1 - e^(-2 sharpness)) / sharpness.
float nook_sg_integral(float sharpness) {
  float x = sharpness;
  // For small x, the difference would cancel, so a series is used.
  float share = x < 0.05 ? 2.0 - x * (2.0 - x * (1.3333333 - 0.6666667 * x)) : (1.0 - exp(-2.0 * x)) / x;
  return 6.2831853 * share;
}

// Returns the integral of the product of two lobes with amplitude 1, in a form that never overflows. `apart`
// is 1 minus the cosine between their axes.
float nook_sg_product_integral(float a, float b, float apart) {
  float sum = a + b;
  float sharpness = sqrt(max(sum * sum - 2.0 * a * b * apart, 0.0));
  float drop = sum > 0.0 ? -2.0 * a * b * apart / (sharpness + sum) : 0.0;
  return exp(drop) * nook_sg_integral(sharpness);
}
#endif
