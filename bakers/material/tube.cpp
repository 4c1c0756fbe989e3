#include "bakers/material/tube.h"

#include <cmath>
#include <numbers>

namespace nook::bake::material {
namespace {

// The section stands upright, so that the frame closes with the curve; a transported frame would come back
// twisted.
Vec3 surface_point(const Tube& tube, float t, float angle) {
  const float step = 0.25f / float(tube.segments);
  // Differences wrap at the ends, where the curve goes on in the next tile.
  const float before = t - step, after = t + step;
  const Vec3 jump = tube.centre(1) - tube.centre(0);
  const Vec3 a = before < 0 ? tube.centre(before + 1) - jump : tube.centre(before);
  const Vec3 b = after > 1 ? tube.centre(after - 1) + jump : tube.centre(after);
  const Vec3 tangent = normalised(b - a);
  const Vec3 side = normalised(cross({0, 0, 1}, tangent));
  const Vec3 up = cross(tangent, side);
  const float scale = tube.radius(t, angle);
  return tube.centre(t) + (scale * tube.half_width * std::cos(angle)) * side +
         (scale * tube.half_height * std::sin(angle)) * up;
}

}  // namespace

void sweep(const Tube& tube, MesoSurface& surface) {
  const auto first = std::uint32_t(surface.position.size());
  const float turn = 2 * std::numbers::pi_v<float>;
  for (std::uint32_t s = 0; s <= tube.segments; ++s)
    for (std::uint32_t k = 0; k < tube.sides; ++k) {
      const float t = float(s) / float(tube.segments), angle = turn * float(k) / float(tube.sides);
      const float along = 0.5f / float(tube.segments), around = 0.5f * turn / float(tube.sides);
      const float t0 = std::max(t - along, 0.0f), t1 = std::min(t + along, 1.0f);
      const Vec3 d_along = surface_point(tube, t1, angle) - surface_point(tube, t0, angle);
      const Vec3 d_around = surface_point(tube, t, angle + around) - surface_point(tube, t, angle - around);
      surface.position.push_back(surface_point(tube, t, angle));
      surface.normal.push_back(normalised(cross(d_around, d_along)));
      surface.albedo.push_back(tube.albedo(t, angle));
    }
  for (std::uint32_t s = 0; s < tube.segments; ++s)
    for (std::uint32_t k = 0; k < tube.sides; ++k) {
      const std::uint32_t next = (k + 1) % tube.sides;
      const std::uint32_t a = first + s * tube.sides + k, b = first + s * tube.sides + next;
      const std::uint32_t c = a + tube.sides, d = b + tube.sides;
      surface.triangle.push_back({a, b, d});
      surface.triangle.push_back({a, d, c});
    }
}

}  // namespace nook::bake::material
