// Weave: a plain weave of two sets of plied yarns, warp along y and weft along x, with gaps between them.
#include <cmath>
#include <numbers>

#include "bakers/material/tube.h"
#include "bakers/raytrace/random.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::material {

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
    // Over one crossing, under the next: crossings lie at (k + 1/2) / count.
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
