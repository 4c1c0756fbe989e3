// What one sphere does to one key point: the solid-angle and visibility terms of the model, and the physical
// form factor for casters that were not part of the fit. Written once over a number type F (float, double, or
// a SIMD vector with the same operators and the functions of core/simd_scalar.h), so that the scalar
// reference and every SIMD path share the formulas.
//
// Two numbers say all about a sphere of centre o and radius r seen from a key point c with unit normal u, d =
// o - c:
//   delta2 = |d|^2 / r^2, the squared distance in radii, and xi = dot(d, u) / r, the height of its centre
//   above the key point's horizon in radii; |xi| <= delta.
#pragma once

#include <cstdint>

#include "sdk/src/core/simd_scalar.h"
#include "shaders/character/constants.h"

namespace nook {

enum class KernelForm : std::uint8_t {
  paper = NOOK_KERNEL_PAPER,        // Le et al. 2019, slide 18
  nook = NOOK_KERNEL_NOOK,          // smooth horizon and a fall-off with the true power of distance
  rational = NOOK_KERNEL_RATIONAL,  // the paper's visibility, a fall-off with the true power of distance
};
inline constexpr int kernel_form_count = 3;

struct Kernel {
  KernelForm form = KernelForm::nook;
  // Exponent of the norm over spheres, >= 1; slide 20. The paper's larger ones keep spheres of neighbours
  // from darkening twice; in the composed form these have a term of their own, and the plain sum fits
  // self-shadow best.
  float gamma = 1;
};

// Visibility of slide 18: 0 for a sphere far below the horizon, 1/2 on it, 1 far above.
template <class F>
F visibility_paper(F xi) {
  return max(fma(xi, rsqrt(fma(F(4.0f) * xi, xi, F(1.0f))), F(0.5f)), F(0.0f));
}

// Omega * Lambda of slide 18. Omega = 3/4 - 3 e / (1 + 4 |e|) with e = delta - 1 is written as one fraction
// with positive terms, (3/4 + 6 max(-e, 0)) / (1 + 4 |e|), so that nothing cancels for far spheres.
template <class F>
F shadow_paper(F xi, F delta2) {
  const F above_zero = max(delta2, F(1e-30f));
  const F e = fma(above_zero, rsqrt(above_zero), F(-1.0f));
  const F inside = max(F(0.0f) - e, F(0.0f));
  const F omega = fma(F(6.0f), inside, F(0.75f)) / fma(F(4.0f), max(e, inside), F(1.0f));
  return omega * visibility_paper(xi);
}

// y = s t^3 with s = (xi + sqrt(xi^2 + 1)) / 2, a smooth positive part of the height, and t = 1 / sqrt(c +
// delta^2): far above the horizon it tends to xi / delta^3, the form factor of a far sphere.
inline constexpr float nook_kernel_core = float(NOOK_KERNEL_CORE);
template <class F>
F shadow_nook(F xi, F delta2) {
  // For spheres far below the horizon the sum cancels and rounding can leave a tiny negative y, which the
  // powers take as 0.
  return (xi + sqrt_positive(fma(xi, xi, F(1.0f)))) * rsqrt_cubed(delta2 + F(nook_kernel_core), 0.5f);
}

template <class F>
F shadow_rational(F xi, F delta2) {
  return F(1.5f) / fma(F(2.0f), delta2, F(1.0f)) * visibility_paper(xi);
}

template <class F>
F shadow_term(KernelForm form, F xi, F delta2) {
  switch (form) {
    case KernelForm::paper:
      return shadow_paper(xi, delta2);
    case KernelForm::rational:
      return shadow_rational(xi, delta2);
    case KernelForm::nook:
      break;
  }
  return shadow_nook(xi, delta2);
}

// Share of the cosine-weighted hemisphere above a surface that a sphere covers, clipped at the horizon. With
// h = delta and c = sqrt((h^2 - 1) / (h^2 - xi^2)), for -1 < xi < 1 < h:
//   f = [ (xi acos(-xi c) / h - sqrt((1 - xi^2)(h^2 - 1))) / h^2 + acos(c) ] / pi,
// xi / h^3 where the sphere is wholly above the horizon (xi >= 1), 0 where it is below (xi <= -1). Inside the
// sphere the true value is 1, which would jump at the surface, where f = (1 + xi) / 2; instead f rises
// smoothly with the depth, f = t + (1 - t)(1 - h^2), t = (1 + xi) / 2, to 1 at the centre: a proxy sphere's
// inside is no solid fact.
template <class F>
F form_factor_exact(F xi, F delta2) {
  const F one(1.0f);
  const F h2 = max(delta2, one);
  const F inverse_h = rsqrt(h2);
  const F s = min(max(xi, F(-1.0f)), one);
  const F above = max(xi, F(0.0f)) * inverse_h * inverse_h * inverse_h;
  const F depth = max(one - delta2, F(0.0f));

  const F outside = h2 - one;
  // On the surface and exactly at the horizon numerator and denominator vanish together.
  const F c = sqrt(min(outside / max(h2 - s * s, F(1e-20f)), one));
  const F k = sqrt(max(one - s * s, F(0.0f)) * outside);
  const F clipped =
      (fma(s * inverse_h, arc_cosine(F(0.0f) - s * c), F(0.0f) - k) * inverse_h * inverse_h + arc_cosine(c)) *
      F(0.31830988618379067f);
  const F f = select(less(xi, one), select(less(F(-1.0f), xi), max(clipped, F(0.0f)), F(0.0f)), above);
  return fma(max(one - f, F(0.0f)), depth, f);
}

// The same without angles, for the many spheres of a caster. With a = 1 / h, b = sqrt(1 - a^2) and t = (1 +
// xi) / 2 clamped to [0, 1], f = a^3 max(xi, 1) (t + t (1 - t) P(b, t)): exact where the sphere is not
// clipped, and P is even in xi because f(xi) - f(-xi) = xi a^3 exactly. P vanishes on the surface (b = 0, f =
// t), far away (b = 1) it is -1 - 0.6044 t (1 - t), which gives 2 / (3 pi) on the horizon and, within 0.004,
// the integral G(xi) = 2/pi int_-xi^1 (xi + x) sqrt(1 - x^2) dx; between, its two free numbers were fitted.
// Error against form_factor_exact: 0.009 at most, 0.005 for h >= 1.05, rms 0.0022.
template <class F>
F form_factor_fast(F xi, F delta2) {
  const F one(1.0f);
  const F a = rsqrt(max(delta2, one));
  const F a2 = a * a;
  const F b = sqrt_positive(max(one - a2, F(1e-30f)));
  const F t = fma(min(max(xi, F(-1.0f)), one), F(0.5f), F(0.5f));
  const F v = t - t * t;
  const F p = fma(v, fma(b, F(-float(NOOK_FORM_FACTOR_1)), F(float(NOOK_FORM_FACTOR_0))),
                  fma(b, F(float(NOOK_FORM_FACTOR_3)), F(-float(NOOK_FORM_FACTOR_2)))) *
              b;
  const F outside = max(a2 * a * max(xi, one) * fma(v, p, t), F(0.0f));
  return fma(max(one - outside, F(0.0f)), max(one - delta2, F(0.0f)), outside);
}

}  // namespace nook
