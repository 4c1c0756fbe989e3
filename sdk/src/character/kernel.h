// The effect of one sphere on one key point. The fitted model uses a solid-angle term and a visibility term.
// Casters that were not part of the fit use the physical form factor. The formulas are templates over a
// number type F: float, double, or a SIMD vector with the same operators and the functions of
// core/simd_scalar.h. Therefore the scalar reference and all SIMD paths use the same source code.
//
// The sphere has the centre o and the radius r. The key point c has the unit normal u. d is o - c. Two
// numbers describe the sphere:
//   delta2 = |d|^2 / r^2, the squared distance in radii, and xi = dot(d, u) / r, the height of its centre
//   above the key point's horizon in radii; |xi| <= delta.
#pragma once

#include <cstdint>

#include "sdk/src/core/simd_scalar.h"
#include "shaders/character/constants.h"

namespace nook {

enum class KernelForm : std::uint8_t {
  paper = NOOK_KERNEL_PAPER,        // Le et al. 2019, slide 18
  nook = NOOK_KERNEL_NOOK,          // smooth horizon, and the physically correct fall-off with distance
  rational = NOOK_KERNEL_RATIONAL,  // the paper's visibility, and the physically correct fall-off with
                                    // distance
};
inline constexpr int kernel_form_count = 3;

struct Kernel {
  KernelForm form = KernelForm::nook;
  // The exponent of the norm over spheres, >= 1 (slide 20). The paper needs larger exponents, because
  // otherwise overlapping spheres of neighbouring bodies darken the same point twice. In Nook, other bodies
  // have a separate term (the composed form), and for self-shadow the plain sum (gamma 1) fits best.
  float gamma = 1;
};

// The visibility of slide 18: 0 for a sphere far below the horizon, 1/2 for a sphere centred on the horizon,
// and 1 far above it.
template <class F>
F visibility_paper(F xi) {
  return max(fma(xi, rsqrt(fma(F(4.0f) * xi, xi, F(1.0f))), F(0.5f)), F(0.0f));
}

// Omega * Lambda of slide 18. Omega = 3/4 - 3 e / (1 + 4 |e|) with e = delta - 1 is written as one fraction
// with positive terms, (3/4 + 6 max(-e, 0)) / (1 + 4 |e|), which avoids cancellation for distant spheres.
template <class F>
F shadow_paper(F xi, F delta2) {
  const F above_zero = max(delta2, F(1e-30f));
  const F e = fma(above_zero, rsqrt(above_zero), F(-1.0f));
  const F inside = max(F(0.0f) - e, F(0.0f));
  const F omega = fma(F(6.0f), inside, F(0.75f)) / fma(F(4.0f), max(e, inside), F(1.0f));
  return omega * visibility_paper(xi);
}

// y = s t^3 with s = (xi + sqrt(xi^2 + 1)) / 2, a smooth positive part of the height, and t = 1 / sqrt(c +
// delta^2). Far above the horizon, y tends to the form factor of a far sphere, xi / delta^3.
inline constexpr float nook_kernel_core = float(NOOK_KERNEL_CORE);
template <class F>
F shadow_nook(F xi, F delta2) {
  // For spheres far below the horizon, cancellation in the sum can leave a tiny negative y. The power
  // functions treat a negative y as 0.
  return (xi + sqrt_positive(fma(xi, xi, F(1.0f)))) * rsqrt_cubed(delta2 + F(nook_kernel_core), 0.5f);
}

// Computes the same y as shadow_nook, but from values in metres that are not divided by r. y = r^2 / 2 (h +
// sqrt(h^2 + r^2)) / d2_and_core^(3/2), where h = r xi is the height and d2_and_core = r^2 (delta2 + core).
// `softness` is r^2. `mass` is 3/4 r^2 instead of r^2 / 2, because rsqrt_cubed is called with the scale 2/3.
// With this scale, the constant factor of the SIMD estimate is 1.
template <class F>
F shadow_nook_of_mass(F h, F d2_and_core, F softness, F mass) {
  return mass * ((h + sqrt_positive(fma(h, h, softness))) * rsqrt_cubed(d2_and_core, 2.0f / 3));
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

// Returns n / (1 + c n), the shadow of a key point, where n is the norm over its spheres. The norm adds up
// all spheres as if no sphere were hidden behind another. But spheres that are close together hide each
// other, so the true shadow grows more slowly than the norm. c is fitted for each key point. c = 0 gives the
// paper's form.
template <class F>
F saturated(F norm, F c) {
  return norm / fma(c, norm, F(1.0f));
}

// Returns the share of a surface's cosine-weighted hemisphere that a sphere covers. The part of the sphere
// below the horizon does not count. Let h be delta and c be sqrt((h^2 - 1) / (h^2 - xi^2)). If -1 < xi < 1 <
// h,
//   f = [ (xi acos(-xi c) / h - sqrt((1 - xi^2)(h^2 - 1))) / h^2 + acos(c) ] / pi.
// If the sphere is completely above the horizon (xi >= 1), f is xi / h^3. If it is completely below (xi <=
// -1), f is 0. On the sphere's surface, f = (1 + xi) / 2. Inside the sphere, the exact value would be 1,
// which is discontinuous. But a proxy sphere is not a solid body. So inside it, f instead rises continuously
// with the depth, up to 1 at the centre: f = t + (1 - t)(1 - h^2) with t = (1 + xi) / 2.
template <class F>
F form_factor_exact(F xi, F delta2) {
  const F one(1.0f);
  const F h2 = max(delta2, one);
  const F inverse_h = rsqrt(h2);
  const F s = min(max(xi, F(-1.0f)), one);
  const F above = max(xi, F(0.0f)) * inverse_h * inverse_h * inverse_h;
  const F depth = max(one - delta2, F(0.0f));

  const F outside = h2 - one;
  // For a point on the surface with xi exactly 1 or -1, numerator and denominator are both 0.
  const F c = sqrt(min(outside / max(h2 - s * s, F(1e-20f)), one));
  const F k = sqrt(max(one - s * s, F(0.0f)) * outside);
  const F clipped =
      (fma(s * inverse_h, arc_cosine(F(0.0f) - s * c), F(0.0f) - k) * inverse_h * inverse_h + arc_cosine(c)) *
      F(0.31830988618379067f);
  const F f = select(less(xi, one), select(less(F(-1.0f), xi), max(clipped, F(0.0f)), F(0.0f)), above);
  return fma(max(one - f, F(0.0f)), depth, f);
}

// An approximation of form_factor_exact without inverse trigonometric functions. Casters use it, because they
// have many spheres. With a = 1 / h, b = sqrt(1 - a^2) and t = (1 + xi) / 2 clamped to [0, 1], f = a^3
// max(xi, 1) (t + t (1 - t) P(b, t)). The formula is exact if the horizon does not clip the sphere. P is even
// in xi, because f(xi) - f(-xi) = xi a^3 exactly. P is 0 on the surface (b = 0, f = t). At infinity (b = 1) P
// is -1 - 0.6044 t (1 - t), which gives 2 / (3 pi) on the horizon and, within 0.004, the integral G(xi) =
// 2/pi int_-xi^1 (xi + x) sqrt(1 - x^2) dx. Between these two limits, two further coefficients are fitted.
// The maximum error against form_factor_exact is 0.009, or 0.005 for h >= 1.05; the rms error is 0.0022.
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

// Returns the optical depth of a caster. d is the sum of weight * form factor over the caster's spheres. If
// the spheres were at random places, they would leave the fraction exp(-d) of the hemisphere open. But the
// spheres of a body lie side by side and hide each other less, so a smaller fraction stays open. For example,
// a single sphere that covers the fraction f leaves 1 - f = exp(-(f + f^2 / 2 + ...)). For vertices of bodies
// 0.3 to 1 m apart, the ray-traced depth is d + 0.2 d^2 to d + 0.45 d^2 up to d = 0.6, where about half is
// open. For larger d, the ray-traced depth is smaller than this function's, so points between two bodies that
// touch become too dark.
template <class F>
F solid_depth(F d) {
  return fma(F(float(NOOK_SOLID_DEPTH)) * d, d, d);
}

}  // namespace nook
