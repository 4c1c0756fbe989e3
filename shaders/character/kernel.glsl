// Computes the effect of one sphere on one key point, with the formulas and names of
// sdk/src/character/kernel.h. delta2 is the squared distance of the sphere's centre, and xi the height of the
// centre above the key point's horizon. Both are in units of the radius.
#include "shaders/character/constants.h"

float nook_visibility_paper(float xi) { return max(xi * inversesqrt(4.0 * xi * xi + 1.0) + 0.5, 0.0); }

float nook_shadow_term(float xi, float delta2) {
#if NOOK_KERNEL_FORM == NOOK_KERNEL_PAPER
  // Le et al. 2019, slide 18.
  float e = sqrt(delta2) - 1.0;
  float inside = max(-e, 0.0);
  return (0.75 + 6.0 * inside) / (1.0 + 4.0 * max(e, inside)) * nook_visibility_paper(xi);
#elif NOOK_KERNEL_FORM == NOOK_KERNEL_NOOK
  // Far below the horizon, xi + sqrt(xi^2 + 1) is a small difference of large values. max() ensures that
  // rounding does not make it negative, because pow needs a non-negative base.
  float t = inversesqrt(delta2 + NOOK_KERNEL_CORE);
  return max(0.5 * (xi + sqrt(xi * xi + 1.0)), 0.0) * t * t * t;
#else
  return 1.5 / (1.0 + 2.0 * delta2) * nook_visibility_paper(xi);
#endif
}

// Returns y^gamma for the norm (slide 20). Common exponents are computed without a logarithm.
float nook_raised(float y, float gamma) {
  if (gamma == 1.5) return y * sqrt(y);
  if (gamma == 2.0) return y * y;
  if (gamma == 1.0) return y;
  return y > 0.0 ? pow(y, gamma) : 0.0;
}
float nook_norm_root(float sum, float gamma) { return sum > 0.0 ? pow(sum, 1.0 / gamma) : 0.0; }
float nook_saturated(float norm, float c) { return norm / (1.0 + c * norm); }

// Returns acos(x) with an error of at most 7e-5 (Abramowitz and Stegun 4.4.45). The precision of GLSL's own
// acos is not specified.
float nook_arc_cosine(float x) {
  float a = abs(x);
  float r = sqrt(max(1.0 - a, 0.0)) * (1.5707288 + a * (-0.2121144 + a * (0.0742610 - 0.0187293 * a)));
  return x < 0.0 ? 3.14159265 - r : r;
}

// Returns the share of the cosine-weighted hemisphere that a sphere covers, clipped at the horizon.
float nook_form_factor_exact(float xi, float delta2) {
  float h2 = max(delta2, 1.0);
  float inverse_h = inversesqrt(h2);
  float s = clamp(xi, -1.0, 1.0);
  float outside = h2 - 1.0;
  float c = sqrt(min(outside / max(h2 - s * s, 1e-20), 1.0));
  float k = sqrt(max(1.0 - s * s, 0.0) * outside);
  float clipped = ((s * inverse_h * nook_arc_cosine(-s * c) - k) * inverse_h * inverse_h + nook_arc_cosine(c)) *
                  0.31830988618379067;
  float f = xi >= 1.0 ? xi * inverse_h * inverse_h * inverse_h : xi > -1.0 ? max(clipped, 0.0) : 0.0;
  return f + max(1.0 - f, 0.0) * max(1.0 - delta2, 0.0);
}

// Returns the optical depth of a caster from the sum over its spheres. sdk/src/character/kernel.h gives the
// reason for the formula.
float nook_solid_depth(float d) { return d + NOOK_SOLID_DEPTH * d * d; }

// Approximates nook_form_factor_exact without inverse trigonometric functions. Casters use it, because they
// have many spheres. sdk/src/character/kernel.h derives the approximation.
float nook_form_factor_fast(float xi, float delta2) {
  float a = inversesqrt(max(delta2, 1.0));
  float a2 = a * a;
  float b = sqrt(max(1.0 - a2, 0.0));
  float t = 0.5 * clamp(xi, -1.0, 1.0) + 0.5;
  float v = t - t * t;
  float p = b * (v * (NOOK_FORM_FACTOR_0 - NOOK_FORM_FACTOR_1 * b) + (NOOK_FORM_FACTOR_3 * b - NOOK_FORM_FACTOR_2));
  float f = max(a2 * a * max(xi, 1.0) * (v * p + t), 0.0);
  return f + max(1.0 - f, 0.0) * max(1.0 - delta2, 0.0);
}
