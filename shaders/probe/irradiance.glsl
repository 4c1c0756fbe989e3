#ifndef NOOK_PROBE_IRRADIANCE
#define NOOK_PROBE_IRRADIANCE
// Computes the irradiance of a lobe on a surface with the unit normal n. sdk/src/core/spherical_gaussian.h has
// the same functions.
#include "shaders/core/constants.h"
#include "shaders/probe/lobe.glsl"

// Approximates the clamped cosine by a lobe. This is cheaper, but the irradiance is not 0 on surfaces that
// face away from a sharp light.
vec3 nook_sg_lobe_irradiance_inner_product(NookLobe lobe, vec3 n) {
  return lobe.amplitude * (NOOK_COSINE_LOBE_AMPLITUDE *
                           nook_sg_product_integral(lobe.sharpness, NOOK_COSINE_LOBE_SHARPNESS,
                                                            nook_probe_apart(lobe.axis, n)));
}

// Returns the irradiance of a lobe with integral 1, by zonal harmonics of the clamped cosine up to band 4.
// `cosine` is dot(axis, n).
float nook_probe_unit_irradiance_bands(float sharpness, float cosine) {
  float x = sharpness, x2 = x * x, b1, b2, b4;
  if (x < 0.5) {
    // For such small values, the recurrence below would lose too many digits.
    b1 = x / 3.0 * (1.0 - x2 / 15.0 * (1.0 - x2 * 2.0 / 21.0));
    b2 = x2 / 15.0 * (1.0 - x2 * 2.0 / 21.0);
    b4 = x2 * x2 / 945.0;
  } else {
    float e = exp(-2.0 * x);
    b1 = (1.0 + e) / (1.0 - e) - 1.0 / x;
    b2 = 1.0 - 3.0 / x * b1;
    b4 = b2 - 7.0 / x * (b1 - 5.0 / x * b2);
  }
  float c2 = cosine * cosine;
  return max(0.25 + 0.5 * b1 * cosine + 0.3125 * b2 * (1.5 * c2 - 0.5) -
                 0.09375 * b4 * ((4.375 * c2 - 3.75) * c2 + 0.375), 0.0);
}

// Uses S. Hill's fit, and the function for bands if the sharpness is below the fit's range.
float nook_probe_unit_irradiance_fitted(float sharpness, float cosine) {
  if (sharpness < NOOK_FITTED_IRRADIANCE_MIN_SHARPNESS) return nook_probe_unit_irradiance_bands(sharpness, cosine);
  float e1 = exp(-sharpness), e2 = e1 * e1, inverse = 1.0 / sharpness;
  float rest = inverse - 2.0 * e2;
  float bias = (e1 - e2) * inverse - e2;
  float x = sqrt(rest);
  const float slope = NOOK_FITTED_IRRADIANCE_SLOPE;
  float x0 = slope * cosine, x1 = x / (4.0 * slope), s = x0 + x1;
  float y = abs(x0) <= x1 ? s * s / x : clamp(cosine, 0.0, 1.0);
  return max((1.0 - rest) * y + bias, 0.0);
}

vec3 nook_sg_lobe_irradiance_fitted(NookLobe lobe, vec3 n) {
  return lobe.amplitude * (nook_sg_integral(lobe.sharpness) *
                           nook_probe_unit_irradiance_fitted(lobe.sharpness, dot(lobe.axis, n)));
}

// Uses the more accurate of the two functions above.
vec3 nook_sg_lobe_irradiance(NookLobe lobe, vec3 n) {
  float cosine = dot(lobe.axis, n);
  float unit = lobe.sharpness <= NOOK_BANDS_MAX_SHARPNESS ? nook_probe_unit_irradiance_bands(lobe.sharpness, cosine)
                                      : nook_probe_unit_irradiance_fitted(lobe.sharpness, cosine);
  return lobe.amplitude * (nook_sg_integral(lobe.sharpness) * unit);
}
#endif
