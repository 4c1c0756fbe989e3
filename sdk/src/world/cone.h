// The share of a cone of directions that a capsule hides, such as the cone of a sun or a lamp.
//
// A cone is cut into `cone_parts` cones of equal solid angle whose axes lie on a spiral (Vogel 1979). Look at
// the plane across a part's axis, at unit distance and in units of the part's radius. There the part is the
// unit disc and a capsule the stadium around a segment, which counts as a rectangle of the same area. Its
// share of the disc is approximated by the product of the shares along and across the segment. Overlap works
// as follows: in each part, the product of what the capsules leave open counts, as if they covered it
// independently. The cone's share is the mean over its parts. So capsules that cover different parts add up,
// and capsules that fully cover the same part do not darken it twice.
#pragma once

#include <cmath>

#include "sdk/src/core/simd_scalar.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/world/coverage.h"

namespace nook::world {

inline constexpr int cone_parts = NOOK_CONE_PARTS;

struct ConeParts {
  Vec3 axis[cone_parts];  // unit, towards the light
  float slope = 0;        // the tangent of a part's half angle
};

// axis: unit, towards the light. half_angle_radians: above 0, below pi / 2.
inline ConeParts cone_parts_of(Vec3 axis, float half_angle_radians) {
  const float sign = std::copysign(1.0f, axis.z), p = -1 / (sign + axis.z), q = axis.x * axis.y * p;
  const Vec3 x{1 + sign * axis.x * axis.x * p, sign * q, -sign * axis.x};  // Duff et al. 2017
  const Vec3 y{q, sign + axis.y * axis.y * p, -axis.y};
  const double versine = 2 * std::pow(std::sin(0.5 * double(half_angle_radians)), 2);
  ConeParts parts;
  for (int i = 0; i < cone_parts; ++i) {
    const double w = versine * (i + 0.5) / cone_parts, angle = 2.399963229728653 * i;  // the golden angle
    const double sine = std::sqrt(w * (2 - w));
    parts.axis[i] =
        float(sine * std::cos(angle)) * x + float(sine * std::sin(angle)) * y + float(1 - w) * axis;
  }
  const double w = versine / cone_parts;
  parts.slope = float(std::sqrt(w * (2 - w)) / (1 - w));
  return parts;
}

// Returns the share of a unit disc beyond a line at the signed distance s, within 0.01 of the exact circular
// segment.
template <class F>
F share_beyond(F s) {
  const F x = min(max(s, F(-1.0f)), F(1.0f));
  return fma(x, fma(x * x, F(0.25f), F(-0.75f)), F(0.5f));
}

// Returns the share of one part in [0, 1]; the receiver is at the origin. 0 if a number is NaN.
template <class F>
F part_coverage(const CapsuleLanes<F>& c, F lx, F ly, F lz, F slope) {
  const F one(1.0f), zero(0.0f);
  const F depth_a = fma(c.ax, lx, fma(c.ay, ly, c.az * lz)),
          depth_b = fma(c.bx, lx, fma(c.by, ly, c.bz * lz));
  // Cuts off what is behind the receiver. The cut is close to the receiver's plane, where the rest appears
  // far aside.
  const F deepest = max(depth_a, depth_b);
  const F least = F(0.02f) * deepest;
  const F range = depth_b - depth_a;
  const F safe = select(less(range * range, F(1e-20f)), F(1e-10f), range);
  const F at = min(max((least - depth_a) / safe, zero), one);
  const F ta = select(less(depth_a, least), at, zero), tb = select(less(depth_b, least), at, one);
  const F ex = c.bx - c.ax, ey = c.by - c.ay, ez = c.bz - c.az;
  const F da = max(fma(ta, range, depth_a), least), db = max(fma(tb, range, depth_a), least);
  const F scale_a = one / max(da * slope, F(1e-12f)), scale_b = one / max(db * slope, F(1e-12f));
  const F ax = (fma(ta, ex, c.ax) - da * lx) * scale_a, ay = (fma(ta, ey, c.ay) - da * ly) * scale_a,
          az = (fma(ta, ez, c.az) - da * lz) * scale_a;
  const F bx = (fma(tb, ex, c.ax) - db * lx) * scale_b, by = (fma(tb, ey, c.ay) - db * ly) * scale_b,
          bz = (fma(tb, ez, c.az) - db * lz) * scale_b;
  const F dx = bx - ax, dy = by - ay, dz = bz - az;
  const F length2 = fma(dx, dx, fma(dy, dy, dz * dz));
  const F inverse = rsqrt(max(length2, F(1e-12f)));
  const F length = length2 * inverse;
  const F xa = fma(ax, dx, fma(ay, dy, az * dz)) * inverse;
  const F a2 = fma(ax, ax, fma(ay, ay, az * az));
  const F aside = sqrt(max(a2 - xa * xa, zero));
  // The radius at the point of the segment that is nearest to the axis.
  const F nearest = min(max((zero - xa) * inverse, zero), one);
  const F ra = fma(ta, c.radius_b - c.radius_a, c.radius_a) * scale_a;
  const F rb = fma(tb, c.radius_b - c.radius_a, c.radius_a) * scale_b;
  const F radius = fma(nearest, rb - ra, ra);
  const F cap = F(0.785398163f) * radius;  // a rectangle of the area of half a disc
  const F across = share_beyond(aside - radius) - share_beyond(aside + radius);
  const F along = share_beyond(xa - cap) - share_beyond(xa + length + cap);
  return select(less(zero, deepest), max(min(across * along, one), zero), zero);
}

}  // namespace nook::world
