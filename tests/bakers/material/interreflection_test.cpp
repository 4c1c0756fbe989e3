#include <cmath>
#include <numbers>

#include "bakers/material/trace_material.h"
#include "tests/bakers/material/plates.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::material;

namespace {

// V-shaped grooves along y with walls of 45 degrees, `grooves` in a tile, each wall in fine strips.
MesoSurface grooved_plane(int grooves, float albedo) {
  MesoSurface s;
  constexpr int strips = 16;
  const float wall = 0.5f / float(grooves);
  for (int w = 0; w < 2 * grooves; ++w)
    for (int i = 0; i < strips; ++i) {
      const bool down = w % 2 == 0;
      const float x0 = wall * (float(w) + float(i) / strips), x1 = wall * (float(w) + float(i + 1) / strips);
      const auto z = [&](float x) { return down ? float(w) * wall - x : x - float(w + 1) * wall; };
      test::add_quad(s, {x0, 0, z(x0)}, {x1, 0, z(x1)}, {x1, 1, z(x1)}, {x0, 1, z(x0)},
                     {albedo, albedo, albedo});
    }
  return s;
}

double mean_from_above(std::uint32_t bounces, float albedo) {
  TraceSettings settings;
  settings.width = 64;
  settings.height = 4;
  settings.samples = 2;
  settings.bounces = bounces;
  settings.bounce_rays = 256;
  const RawMaterial raw =
      trace_material(grooved_plane(4, albedo), {Vec3{0, 0, 1}}, {Vec3{0, 0, 1}}, settings);
  double sum = 0;
  for (const float v : raw.btf) sum += double(v);
  return sum / double(raw.btf.size());
}

}  // namespace

TEST_CASE("inter-reflection in V-grooves agrees with their form factor") {
  // Under a light from above both walls have the irradiance cos 45 throughout. The form factor between the
  // walls of an endless groove is 1 - sin(half the opening angle), and an image from above weighs a wall's
  // parts evenly, so that the first bounce adds exactly albedo x form factor in the mean.
  const double albedo = 0.8, form_factor = 1 - std::sin(std::numbers::pi / 4);
  const double direct = albedo * std::cos(std::numbers::pi / 4) * std::numbers::inv_pi;
  // Half floats; and texels that the ridge cuts.
  CHECK(mean_from_above(0, float(albedo)) == Approx(direct).epsilon(2e-3));
  // 256 rays for each of 256 vertices along the groove leave 0.4 % noise of the bounce; interpolation between
  // vertices overshoots the steep rise at the bottom by about as much.
  CHECK(mean_from_above(1, float(albedo)) == Approx(direct * (1 + albedo * form_factor)).epsilon(0.01));
  // Further bounces: between the geometric series of the mean form factor and what no escape would give.
  const double second = mean_from_above(2, float(albedo));
  CHECK(second > direct * (1 + albedo * form_factor) * 1.005);
  CHECK(second < direct * (1 + albedo * form_factor + albedo * albedo * form_factor));
}

TEST_CASE("a plane does not light itself") {
  TraceSettings settings;
  settings.width = settings.height = 4;
  settings.bounces = 2;
  settings.bounce_rays = 32;
  const RawMaterial raw =
      trace_material(test::flat_plate(0, {1, 1, 1}), {Vec3{0, 0, 1}}, {Vec3{0, 0, 1}}, settings);
  for (const float v : raw.btf) CHECK(v == Approx(std::numbers::inv_pi).epsilon(1e-3));
}
