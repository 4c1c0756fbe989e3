// Irradiance of a lobe on a surface with unit normal n; the same as sdk/src/core/spherical_gaussian.h.
#include "probe/lobe.glsl"

// The clamped cosine as a lobe: cheaper, and not 0 behind sharp lights.
vec3 nook_probe_lobe_irradiance_inner_product(NookLobe lobe, vec3 n) {
  return lobe.amplitude * (1.17 * nook_probe_lobe_product_integral(lobe.sharpness, 2.133, nook_probe_apart(lobe.axis, n)));
}

// Of integral 1; cosine is dot(axis, n). S. Hill's fit, and below its range three bands of zonal harmonics.
float nook_probe_unit_irradiance(float sharpness, float cosine) {
  if (sharpness < 1.25) {
    float e = exp(-2.0 * sharpness);
    float mean = sharpness < 0.05 ? sharpness / 3.0 : 1.0 - (1.0 / sharpness - 2.0 * e / (1.0 - e));
    float second = sharpness < 0.05 ? sharpness * sharpness / 15.0 : 1.0 - 3.0 * mean / sharpness;
    return max(0.25 + 0.5 * mean * cosine + 0.3125 * second * (1.5 * cosine * cosine - 0.5), 0.0);
  }
  float e1 = exp(-sharpness), e2 = e1 * e1, inverse = 1.0 / sharpness;
  float scale = 1.0 + 2.0 * e2 - inverse;
  float bias = (e1 - e2) * inverse - e2;
  float x = sqrt(1.0 - scale);
  float x0 = 0.36 * cosine, x1 = x / (4.0 * 0.36), s = x0 + x1;
  float y = abs(x0) <= x1 ? s * s / x : clamp(cosine, 0.0, 1.0);
  return max(scale * y + bias, 0.0);
}

vec3 nook_probe_lobe_irradiance(NookLobe lobe, vec3 n) {
  return lobe.amplitude *
         (nook_probe_lobe_integral(lobe.sharpness) * nook_probe_unit_irradiance(lobe.sharpness, dot(lobe.axis, n)));
}
