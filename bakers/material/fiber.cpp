// Fiber: a loose mat of thin round fibres that wander over and under each other; the gaps let the ground
// through.
#include <cmath>
#include <numbers>

#include "bakers/material/tube.h"
#include "bakers/raytrace/random.h"

namespace nook::bake::material {
namespace {

struct Wave {
  float amplitude, turns, phase;
  float at(float t) const {
    return amplitude * std::sin(2 * std::numbers::pi_v<float> * (turns * t + phase));
  }
};

}  // namespace

MesoSurface make_fiber(const MesoParameters& p) {
  MesoSurface surface;
  surface.specular = 0.06f;
  surface.shininess = 24;
  // Courses over the torus, as tiles along x and y until a fibre meets itself.
  constexpr int courses[][2] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 1}, {-1, 2}, {-2, 1}, {1, 2}};
  Random random(p.seed);
  for (std::uint32_t i = 0; i < p.count; ++i) {
    const auto& course = courses[i % std::size(courses)];
    const float span = std::hypot(float(course[0]), float(course[1]));
    const Vec3 along = normalised({float(course[0]), float(course[1]), 0}), across{-along.y, along.x, 0};
    const Vec3 start{random.unit(), random.unit(), 0};
    // Even layers, in a random order of courses, so that the mat has its height with any count.
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

}  // namespace nook::bake::material
