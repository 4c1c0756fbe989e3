// Tubes swept along curves, and the meso-structures made of them: fibres and yarns.
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "bakers/material/meso_surface.h"
#include "bakers/raytrace/random.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::material {
namespace {

// A tube along a curve that continues in the next tiles: its end minus its start must be a whole number of
// tiles along x and y. The curve must not be vertical anywhere.
struct Tube {
  std::function<Vec3(float t)> centre;                // t in [0, 1]
  std::function<float(float t, float angle)> radius;  // relative to the half axes; angle 0 points sideways
  float half_width = 0.01f, half_height = 0.01f;      // half axes of the section, tiles
  std::function<Vec3(float t, float angle)> albedo;
  std::uint32_t segments = 64, sides = 12;
};

// Keeps the cross-section upright, so that it is the same at the end of the curve as at the start. With
// parallel transport of the frame, it would be twisted at the end.
Vec3 surface_point(const Tube& tube, float t, float angle) {
  const float step = 0.25f / float(tube.segments);
  // Differences wrap at the ends, because the curve continues in the next tile.
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

// Appends the tube. Its first and its last ring coincide on the torus.
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

struct Wave {
  float amplitude, turns, phase;
  float at(float t) const {
    return amplitude * std::sin(2 * std::numbers::pi_v<float> * (turns * t + phase));
  }
};

}  // namespace

// Fiber is a loose mat of thin round fibres that wander over and under each other. The ground shows through
// the gaps.
MesoSurface make_fiber(const MesoParameters& p) {
  MesoSurface surface;
  surface.specular = 0.06f;
  surface.shininess = 24;
  // Directions of fibres. A fibre meets itself after this number of tiles along x and y.
  constexpr int courses[][2] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 1}, {-1, 2}, {-2, 1}, {1, 2}};
  Random random(p.seed);
  for (std::uint32_t i = 0; i < p.count; ++i) {
    const auto& course = courses[i % std::size(courses)];
    const float span = std::hypot(float(course[0]), float(course[1]));
    const Vec3 along = normalised({float(course[0]), float(course[1]), 0}), across{-along.y, along.x, 0};
    const Vec3 start{random.unit(), random.unit(), 0};
    // Spreads the fibres evenly over the height, so that the mat has the same height for any number of
    // fibres.
    const float layer = (float(i) + random.unit()) / float(p.count) - 0.5f;
    const float centre_height = (p.thickness - 2 * p.radius) * layer * 0.8f;
    Wave sideways[3], up[2];
    for (int k = 0; k < 3; ++k)
      sideways[k] = {p.roughness * (0.5f + random.unit()) / float(k + 1), float(k + 1), random.unit()};
    for (int k = 0; k < 2; ++k)
      up[k] = {0.12f * p.thickness * random.unit(), std::round(span * float(k + 1)), random.unit()};
    const Wave swelling{0.12f, std::round(3 * span), random.unit()};
    const float tone = random.unit(), redness = random.unit();
    const Vec3 colour =
        Vec3{0.62f, 0.36f + 0.12f * redness, 0.16f + 0.14f * redness} * (0.55f + 0.75f * tone);

    Tube tube;
    tube.centre = [=](float t) {
      float sum = 0, height = centre_height;
      for (const Wave& w : sideways) sum += w.at(t);
      for (const Wave& w : up) height += w.at(t);
      return start + Vec3{float(course[0]) * t, float(course[1]) * t, height} + across * sum;
    };
    tube.radius = [=](float t, float) { return 1 + swelling.at(t); };
    tube.albedo = [=](float t, float) { return colour * (1 + 0.6f * swelling.at(t)); };
    tube.half_width = tube.half_height = p.radius * (0.7f + 0.6f * random.unit());
    tube.segments = std::uint32_t(std::lround(72 * span * p.detail));
    tube.sides = std::uint32_t(std::max(6l, std::lround(10 * p.detail)));
    sweep(tube, surface);
  }
  return surface;
}

// Weave is a plain weave of two sets of plied yarns, warp along y and weft along x, with gaps between them.

MesoSurface make_weave(const MesoParameters& p) {
  if (p.count % 2 != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "a weave needs an even number of yarns to repeat (got %u); use an even one", p.count);
  MesoSurface surface;
  surface.specular = 0.04f;
  surface.shininess = 12;
  const float pi = std::numbers::pi_v<float>;
  constexpr float plies = 3, twists_per_yarn_spacing = 2;
  Random random(p.seed);
  for (std::uint32_t i = 0; i < 2 * p.count; ++i) {
    const bool warp = i < p.count;
    const std::uint32_t index = i % p.count;
    const float offset = (float(index) + 0.5f) / float(p.count);
    const float parity = (index % 2 == 0) == warp ? 1.0f : -1.0f;
    // A yarn goes over one crossing and under the next. The crossings are at (k + 1/2) / count tiles.
    const float turns = float(p.count) / 2, lift = 0.5f * p.thickness;
    const float phase = random.unit(), tone = 0.85f + 0.3f * random.unit();
    const float twist = plies * twists_per_yarn_spacing * float(p.count);
    const Vec3 colour = (warp ? Vec3{0.16f, 0.24f, 0.46f} : Vec3{0.74f, 0.69f, 0.58f}) * tone;

    Tube tube;
    tube.centre = [=](float t) {
      const float height = parity * lift * std::sin(2 * pi * turns * t);
      return warp ? Vec3{offset, t, height} : Vec3{t, offset, height};
    };
    const auto ridge = [=](float t, float angle) {
      return std::cos(plies * angle + 2 * pi * (std::round(twist) * t + phase));
    };
    tube.radius = [=](float t, float angle) { return 1 + p.roughness * (ridge(t, angle) - 1) / 2; };
    tube.albedo = [=](float t, float angle) { return colour * (0.9f + 0.1f * ridge(t, angle)); };
    tube.half_width = p.radius;
    tube.half_height = 0.5f * p.thickness;
    tube.segments = std::uint32_t(std::lround(160 * p.detail));
    tube.sides = std::uint32_t(std::max(8l, std::lround(28 * p.detail)));
    sweep(tube, surface);
  }
  return surface;
}

}  // namespace nook::bake::material
