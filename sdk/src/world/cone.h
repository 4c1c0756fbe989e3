// Computes which share of a cone of directions is hidden by capsules. The cone contains, for example, the
// directions to a sun or a lamp.
//
// The cone is divided into `cone_parts` smaller cones (parts) of equal solid angle, whose axes lie on two
// rings. To find the share of a part that a capsule hides, both are projected to the plane that is
// perpendicular to the part's axis. In this plane, in units of the part's radius, the part is the unit disc,
// and a capsule is the convex hull of two discs. If the capsule is wider than the part, it is treated as a
// half-plane. The border of the half-plane is as far from the part's axis as the edge of the capsule. If the
// capsule is narrower, it is treated as a rectangle of the same area. The share of the part that it hides is
// then the product of two shares: one along the rectangle and one across it. In each part, the open shares of
// all capsules are multiplied together, as if the capsules covered the part independently. The open share of
// the cone is the mean over its parts. So if capsules cover different parts, their shares add up. If several
// capsules fully cover the same part, it is darkened only once.
#pragma once

#include <cmath>

#include "sdk/src/core/simd_scalar.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/world/coverage.h"

namespace nook::world {

inline constexpr int cone_parts = NOOK_CONE_PARTS;
inline constexpr int inner_parts = 5;  // number of parts on the inner ring

struct ConeParts {
  Vec3 axis[cone_parts];  // unit vector towards the light
  float slope = 0;        // the tangent of a part's half angle
};

// `axis` must be a unit vector towards the light. half_angle_radians must be above 0 and below pi / 2.
inline ConeParts cone_parts_of(Vec3 axis, float half_angle_radians) {
  const float sign = std::copysign(1.0f, axis.z), p = -1 / (sign + axis.z), q = axis.x * axis.y * p;
  const Vec3 x{1 + sign * axis.x * axis.x * p, sign * q, -sign * axis.x};  // Duff et al. 2017
  const Vec3 y{q, sign + axis.y * axis.y * p, -axis.y};
  const double versine = 2 * std::pow(std::sin(0.5 * double(half_angle_radians)), 2);
  ConeParts parts;
  for (int i = 0; i < cone_parts; ++i) {
    // The radii of the rings are chosen so that the penumbra of a straight edge differs by at most 0.012 from
    // the exact disc segment, for every direction of the edge. With 16 parts on a spiral (Vogel 1979), the
    // difference is 0.043, which is visible as bands.
    const bool inner = i < inner_parts;
    const double radius = inner ? 0.35 : 0.79, w = versine * radius * radius;
    const double angle =
        2 * 3.14159265358979 *
        (inner ? double(i) / inner_parts : double(i - inner_parts) / (cone_parts - inner_parts));
    const double sine = std::sqrt(w * (2 - w));
    parts.axis[i] =
        float(sine * std::cos(angle)) * x + float(sine * std::sin(angle)) * y + float(1 - w) * axis;
  }
  const double w = versine / cone_parts;
  parts.slope = float(std::sqrt(w * (2 - w)) / (1 - w));
  return parts;
}

// Returns the share of a unit disc that is beyond a line. s is the signed distance of the line from the
// centre. The error against the exact circular segment is at most 0.008, and the slope at the middle is
// exact.
template <class F>
F share_beyond(F s) {
  const F x = min(max(s, F(-1.0f)), F(1.0f));
  return fma(x, fma(x * x, F(float(NOOK_SEGMENT_3)), F(float(NOOK_SEGMENT_1))), F(0.5f));
}

// Returns the share of one part that a capsule hides, in [0, 1]. The receiver is at the origin. If a value is
// NaN, the share is 0.
template <class F>
F part_coverage(const CapsuleLanes<F>& c, F lx, F ly, F lz, F slope) {
  const F one(1.0f), zero(0.0f);
  const F depth_a = fma(c.ax, lx, fma(c.ay, ly, c.az * lz)),
          depth_b = fma(c.bx, lx, fma(c.by, ly, c.bz * lz));
  // Cuts off the part of the capsule that is behind the receiver. The cut is only slightly in front of the
  // plane through the receiver, so the end of the remaining capsule is projected far to the side.
  const F deepest = max(depth_a, depth_b);
  const F least = F(0.02f) * deepest;
  const F da = max(depth_a, least), db = max(depth_b, least);
  const F range = depth_b - depth_a;
  const F inverse_range = range / max(range * range, F(1e-20f));
  const F ta = (da - depth_a) * inverse_range, tb = fma(db - depth_b, inverse_range, one);
  const F scale = one / (da * db * slope), scale_a = db * scale, scale_b = da * scale;
  const F ex = c.bx - c.ax, ey = c.by - c.ay, ez = c.bz - c.az, er = c.radius_b - c.radius_a;
  const F ax = (fma(ta, ex, c.ax) - da * lx) * scale_a, ay = (fma(ta, ey, c.ay) - da * ly) * scale_a,
          az = (fma(ta, ez, c.az) - da * lz) * scale_a;
  const F bx = (fma(tb, ex, c.ax) - db * lx) * scale_b, by = (fma(tb, ey, c.ay) - db * ly) * scale_b,
          bz = (fma(tb, ez, c.az) - db * lz) * scale_b;
  const F ra = fma(ta, er, c.radius_a) * scale_a, rb = fma(tb, er, c.radius_a) * scale_b;
  const F dx = bx - ax, dy = by - ay, dz = bz - az, dr = rb - ra;
  const F length2 = fma(dx, dx, fma(dy, dy, fma(dz, dz, F(1e-12f))));
  const F inverse = rsqrt(length2), length = length2 * inverse;
  const F xa = fma(ax, dx, fma(ay, dy, az * dz)) * inverse;
  const F a2 = fma(ax, ax, fma(ay, ay, az * az));
  const F aside2 = max(a2 - xa * xa, zero), aside = sqrt(aside2);
  // Of all discs between the capsule's ends, finds the one whose edge is nearest to the part's axis. If the
  // capsule is tapered, this disc is not at the foot of the perpendicular, but closer to the thicker end.
  const F nearest = min(max(fma(dr * inverse, aside, zero - xa) * inverse, zero), one);
  const F radius = fma(nearest, dr, ra), along_x = fma(nearest, length, xa);
  const F distance = sqrt(fma(along_x, along_x, aside2));
  const F edge = share_beyond(distance - radius);
  const F cap = F(0.785398163f) * radius;  // length of a rectangle with the area of half a disc
  const F across = share_beyond(aside - radius) - share_beyond(aside + radius);
  const F along = share_beyond(xa - cap) - share_beyond(xa + length + cap);
  const F narrow = across * along;
  const F wide = min(max(radius - F(float(NOOK_NARROW_RADIUS)), zero), one);
  return select(less(F(1e-6f), deepest), max(min(fma(wide, edge - narrow, narrow), one), zero), zero);
}

}  // namespace nook::world
