// Computes the share of the cosine-weighted hemisphere above a surface point that a capsule covers. As in the
// kernels in sdk/src/character, the formulas are templates over a number type F: float, double, a SIMD vector
// or a dual number.
//
// Seen from a point, a capsule is the convex hull of two discs on the unit sphere: directions u and v to its
// ends, sines s_u and s_v of their angular radii, and c = dot(u, v). Lambert's contour integral of this
// region has two arcs of great circles, which touch both discs, and the outer arcs of the discs. With
//   alpha = (s_u - c s_v) / (1 - c^2), beta = (s_v - c s_u) / (1 - c^2), gamma^2 = 1 - alpha s_u - beta s_v,
// the great circles have the normals alpha u + beta v +- gamma w, where w is perpendicular to u and v. Each
// of the four arcs has a closed form. Their sum is the vector
//   pi Phi = (lambda alpha + phi_u s_u^2 + gamma s beta) u + (lambda beta + phi_v s_v^2 + gamma s alpha) v,
//   s = sqrt(1 - c^2), cos(lambda) = (c - s_u s_v) / (c_u c_v), cos(phi_u) = beta s / c_u,
//   cos(phi_v) = alpha s / c_v, c_u = sqrt(1 - s_u^2).
// dot(n, Phi) is the form factor. It is exact if the capsule is above the horizon. If one disc hides the
// other, clamping the cosines to [-1, 1] gives the larger disc's form factor.
//
// On the surface of a capsule, the region is a half-space. A point inside a capsule uses the half-space of
// the nearest point of the surface, so that the share is continuous. If the sphere at an end of the capsule
// contains the point, the sine of this end is limited to just below 1. If the point is inside the capsule
// between its ends, no great circle touches both discs, and gamma^2 would be negative. There Phi is the unit
// vector towards the axis, (alpha u + beta v) / sqrt(alpha s_u + beta s_v).
#pragma once

#include "sdk/src/core/light_bands.h"
#include "sdk/src/core/simd_scalar.h"
#include "shaders/world/constants.h"

namespace nook::world {

// Returns the angle whose versine (1 - cosine) is w in [0, 2]. For small angles, the versine does not lose
// digits, unlike the cosine.
template <class F>
F angle_of_versine(F w) {
  const F one(1.0f);
  const F x = max(w - one, one - w);  // |cosine|
  const F p = fma(fma(fma(F(float(NOOK_ARC_3)), x, F(float(NOOK_ARC_2))), x, F(float(NOOK_ARC_1))), x,
                  F(float(NOOK_ARC_0)));
  const F r = sqrt(max(min(w, F(2.0f) - w), F(0.0f))) * p;
  return select(less(one, w), F(3.14159265f) - r, r);
}

template <class F>
F angle_of_cosine(F cosine) {
  return angle_of_versine(F(1.0f) - min(max(cosine, F(-1.0f)), F(1.0f)));
}

// Phi = a u + b v.
template <class F>
struct HullFactor {
  F a, b;
};

// `su` and `sv` are s_u and s_v, and must be below 1. `spread` is 1 - c.
template <class F>
HullFactor<F> hull_factor(F su, F sv, F spread) {
  const F one(1.0f), zero(0.0f);
  const F s2 = max(spread * (F(2.0f) - spread), F(float(NOOK_SMALLEST_SPREAD)));
  const F inverse_s = rsqrt(s2);
  const F inverse_s2 = inverse_s * inverse_s, s = s2 * inverse_s;
  const F difference = su - sv;
  const F alpha = fma(spread, sv, difference) * inverse_s2;
  const F beta = fma(spread, su, zero - difference) * inverse_s2;
  const F across2 = alpha * su + beta * sv;  // the squared length of alpha u + beta v
  const F gamma = sqrt(max(one - across2, zero));
  const F cu = sqrt(one - su * su), cv = sqrt(one - sv * sv);
  const F inverse_cu = one / cu, inverse_cv = one / cv;
  // cu cv + su sv = 1 - ((su - sv)^2 + (cu - cv)^2) / 2 is computed without cancellation.
  const F apart = difference * (su + sv) / (cu + cv);
  const F near = F(0.5f) * fma(difference, difference, apart * apart);
  const F versine = (spread - near) * inverse_cu * inverse_cv;
  const F lambda = angle_of_versine(min(max(versine, zero), F(2.0f)));
  const F phi_u = angle_of_cosine(beta * s * inverse_cu), phi_v = angle_of_cosine(alpha * s * inverse_cv);
  const F inverse_pi(0.318309886f);
  const F a = fma(lambda, alpha, fma(phi_u, su * su, gamma * s * beta)) * inverse_pi;
  const F b = fma(lambda, beta, fma(phi_v, sv * sv, gamma * s * alpha)) * inverse_pi;
  // gamma is also 0 if one disc hides the other, but the angle between the ends is small in that case.
  const F within = select(less(one, versine), across2, zero);
  const F inverse_across = rsqrt(max(across2, F(1e-12f)));
  return {select(less(one, within), alpha * inverse_across, a),
          select(less(one, within), beta * inverse_across, b)};
}

// Returns the covered share of the hemisphere above the horizon. `factor` is dot(n, Phi), and `size2` is
// |Phi|^2. For each sphere at an end of the capsule, take the height of its centre above the horizon, divided
// by its radius; `lowest` is the smaller value. It is at least 1 if the whole capsule is above the horizon.
//
// The region is treated as the disc that has the same vector Phi: its sine is sqrt(|Phi|), and t = dot(n,
// Phi) / |Phi|^(3/2) is the height of its centre in radii. The disc's share above the horizon is |Phi|^(3/2)
// (t + x(t)) for |t| < 1, where x(t) = (1 - t) / 2 - w1 (1 - t^2) - w2 (1 - t^2)^2 satisfies x(t) - x(-t) =
// -t exactly. w1 and w2 are polynomials in sqrt(1 - |Phi|). They are 0 on the surface, and give the exact
// share far away. The error of this fit against the closed form of a disc is at most 0.0052, and its RMS
// error is 0.001.
template <class F>
F above_horizon(F factor, F size2, F lowest) {
  const F one(1.0f), zero(0.0f);
  const F inverse_size = rsqrt(max(size2, F(1e-20f)));
  const F size = min(size2 * inverse_size, one);
  const F cube = size * sqrt(size);
  const F height = factor * sqrt(inverse_size) * inverse_size;
  const F t = min(max(max(height, lowest), F(-1.0f)), one);
  const F b = sqrt(one - size), q = one - t * t;
  const F w1 =
      b * fma(b, fma(b, F(float(NOOK_HORIZON_12)), F(float(NOOK_HORIZON_11))), F(float(NOOK_HORIZON_10)));
  const F w2 =
      b * fma(b, fma(b, F(float(NOOK_HORIZON_22)), F(float(NOOK_HORIZON_21))), F(float(NOOK_HORIZON_20)));
  const F x = fma(F(0.5f), one - t, zero - q * fma(w2, q, w1));
  return select(less(F(-1.0f), height), max(fma(cube, x, factor), zero), zero);
}

// A capsule relative to its receiver: the vectors from the receiver to the capsule's ends, and the radii.
template <class F>
struct CapsuleLanes {
  F ax, ay, az, bx, by, bz, radius_a, radius_b;
};

// Returns the covered share, in [0, 1], and the vector Phi. The receiver is at the origin, and `normal` must
// be a unit vector. If an input is NaN, Phi is NaN and the share is 0.
template <class F>
F coverage(const CapsuleLanes<F>& capsule, F nx, F ny, F nz, Direction<F>& phi) {
  const F one(1.0f), zero(0.0f), tiny(1e-24f);
  const F a2 = fma(capsule.ax, capsule.ax, fma(capsule.ay, capsule.ay, capsule.az * capsule.az));
  const F b2 = fma(capsule.bx, capsule.bx, fma(capsule.by, capsule.by, capsule.bz * capsule.bz));
  const F ia = rsqrt(max(a2, tiny)), ib = rsqrt(max(b2, tiny));
  // With this order of the arguments, min returns a NaN unchanged.
  const F su = min(F(float(NOOK_LARGEST_SINE)), capsule.radius_a * ia);
  const F sv = min(F(float(NOOK_LARGEST_SINE)), capsule.radius_b * ib);
  const F ux = capsule.ax * ia, uy = capsule.ay * ia, uz = capsule.az * ia;
  const F vx = capsule.bx * ib, vy = capsule.by * ib, vz = capsule.bz * ib;
  const F dx = ux - vx, dy = uy - vy, dz = uz - vz;
  const F spread = F(0.5f) * fma(dx, dx, fma(dy, dy, dz * dz));
  const F nu = fma(ux, nx, fma(uy, ny, uz * nz)), nv = fma(vx, nx, fma(vy, ny, vz * nz));
  const HullFactor<F> hull = hull_factor(su, sv, spread);
  const F factor = fma(hull.a, nu, hull.b * nv);
  const F sum = hull.a + hull.b;
  // |a u + b v|^2 = (a + b)^2 - 2 a b (1 - c).
  const F size2 = max(fma(sum, sum, F(-2.0f) * hull.a * hull.b * spread), zero);
  const F lowest = min(nu / su, nv / sv);
  phi = {fma(hull.a, ux, hull.b * vx), fma(hull.a, uy, hull.b * vy), fma(hull.a, uz, hull.b * vz)};
  return min(max(above_horizon(factor, size2, lowest), zero), one);
}

template <class F>
F coverage(const CapsuleLanes<F>& capsule, F nx, F ny, F nz) {
  Direction<F> phi;
  return coverage(capsule, nx, ny, nz, phi);
}

}  // namespace nook::world
