// The path tracer against closed forms: it is the ground truth of lighting.
#include "bakers/raytrace/path_tracer.h"

#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "tests/bakers/raytrace/sphere_soup.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

Environment uniform_sky(Vec3 rgb) {
  return Environment(1, 1, {rgb.x, rgb.y, rgb.z});
}

LitTriangles with_surface(TriangleSoup soup, const Surface& surface) {
  LitTriangles lit{std::move(soup), {surface}, {}};
  lit.triangle_surface.assign(lit.soup.triangle.size(), 0);
  return lit;
}

TriangleSoup square_overhead(float half, float height) {
  return {{{-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half}},
          {{0, 1, 2}, {0, 2, 3}}};
}

Vec3 irradiance_of(const LitScene& scene, Vec3 position, Vec3 normal, IrradianceSettings settings) {
  return trace_irradiance(scene, {{&position, 1}, {&normal, 1}}, settings)[0];
}

IrradianceSettings many_rays(std::uint32_t rays) {
  IrradianceSettings settings;
  settings.rays = rays;
  return settings;
}

}  // namespace

TEST_CASE("an open sky of constant radiance gives pi times it") {
  const LitScene scene({}, uniform_sky({1, 2, 0.5f}));
  for (Vec3 normal : {Vec3{0, 1, 0}, Vec3{0.6f, 0, -0.8f}, Vec3{0, -1, 0}}) {
    const Vec3 e = irradiance_of(scene, {5, 5, 5}, normal, many_rays(16384));
    // Uniform against cosine-weighted samples: a standard deviation of about a third a path, 0.3 % of the
    // mean of 16,384.
    CHECK(std::abs(e.x / pi - 1) < 0.012f);
    CHECK(std::abs(e.y / (2 * e.x) - 1) < 1e-4f);  // the same paths
    CHECK(std::abs(e.z / (0.5f * e.x) - 1) < 1e-4f);
  }
}

TEST_CASE("white furnace: inside and outside white bodies all light comes back") {
  // A white sphere under a white sky sends back what it gets: every point sees radiance 1 in every direction,
  // whatever it hits.
  Surface white;
  white.base_colour = {1, 1, 1};
  const LitScene outside(with_surface(sphere_soup({0, 2, 0}, 1, 32), white), uniform_sky({1, 1, 1}));
  IrradianceSettings settings = many_rays(4096);
  settings.path.origin_offset = 1e-3f;
  const Vec3 under = irradiance_of(outside, {0, 0.9f, 0}, {0, 1, 0}, settings);
  CHECK(std::abs(under.x / pi - 1) < 0.03f);  // 0.5 a path: standard error 0.8 %

  // A closed room of base colour a whose walls shine: L = emission + a L, radiance emission / (1 - a)
  // everywhere.
  Surface lamp;
  lamp.base_colour = {0.5f, 0.75f, 0};
  lamp.emission = {1, 1, 1};
  const LitScene room(with_surface(sphere_soup({0, 0, 0}, 1, 32), lamp), uniform_sky({9, 9, 9}));
  const Vec3 inside = irradiance_of(room, {0.1f, 0.2f, -0.3f}, {0, 0, 1}, settings);
  CHECK(std::abs(inside.x / (pi * 2) - 1) < 0.03f);  // roulette's scatter: standard error 1 %
  CHECK(std::abs(inside.y / (pi * 4) - 1) < 0.05f);
  CHECK(std::abs(inside.z / pi - 1) < 1e-4f);  // nothing is random: the first wall ends it
  Random random(7);
  double mean = 0;
  for (int i = 0; i < 4096; ++i)
    mean += double(trace_radiance(room, {0, 0, 0}, {0, 0, 1}, settings.path, random).x) / 4096;
  CHECK(std::abs(mean / 2 - 1) < 0.05);
}

TEST_CASE("bounces that do not count are left out") {
  Surface lamp;
  lamp.base_colour = {0.5f, 0.5f, 0.5f};
  lamp.emission = {1, 1, 1};
  const LitScene room(with_surface(sphere_soup({0, 0, 0}, 1, 32), lamp), uniform_sky({9, 9, 9}));
  IrradianceSettings settings = many_rays(64);
  settings.path.origin_offset = 1e-3f;
  float series = 1;
  for (std::uint32_t bounces = 0; bounces <= 3; ++bounces) {
    settings.path.max_bounces = bounces;
    // Every wall is alike and roulette begins later: exact up to rounding.
    CHECK(std::abs(irradiance_of(room, {0.1f, 0, 0}, {0, 1, 0}, settings).x / (pi * series) - 1) < 1e-4f);
    Random random(1);
    CHECK(std::abs(trace_radiance(room, {0, 0, 0}, {0, 1, 0}, settings.path, random).x / series - 1) < 1e-4f);
    series += std::pow(0.5f, float(bounces + 1));
  }
}

TEST_CASE("a sphere light gives pi L r^2 cos / d^2") {
  Surface lamp;
  lamp.base_colour = {};
  lamp.emission = {3, 3, 3};
  const float radius = 0.5f, distance = 2;
  for (float tilt : {0.0f, 0.7f}) {
    const Vec3 centre = distance * Vec3{std::sin(tilt), std::cos(tilt), 0};
    const LitScene scene(with_surface(sphere_soup(centre, radius, 64), lamp), uniform_sky({0, 0, 0}));
    const float expected = pi * 3 * std::cos(tilt) * radius * radius / (distance * distance);
    const float got = irradiance_of(scene, {0, 0, 0}, {0, 1, 0}, many_rays(16384)).x;
    CHECK(std::abs(got / expected - 1) <
          0.05f);  // a sixteenth of the paths hit: standard error below 3 % unstratified
  }
}

TEST_CASE("half of the hemisphere open to a small sun or to none") {
  // A sun of one texel at the middle of the upper half, straight light of solid angle w: E = L w cos.
  std::vector<float> rgb(3 * 64 * 32, 0.0f);
  const std::size_t sun = 8 * 64 + 32;
  for (std::size_t c = 0; c < 3; ++c) rgb[3 * sun + c] = 1000;
  const Environment map(64, 32, rgb);
  const Vec3 towards = map.direction(32, 8, 0.5f, 0.5f);
  // The texel's own mean cosine differs from the cosine of its middle by (pi / 32)^2 / 24 = 0.04 %.
  const float expected = 1000 * float(map.solid_angle(8)) * towards.y;
  const LitScene open({}, map);
  CHECK(std::abs(irradiance_of(open, {0, 0, 0}, {0, 1, 0}, many_rays(1024)).x / expected - 1) < 0.01f);

  TriangleSoup wall;  // hides x > 0, where the sun stands
  wall.position = {
      {0.001f, -1e4f, -1e4f}, {0.001f, 1e4f, -1e4f}, {0.001f, 1e4f, 1e4f}, {0.001f, -1e4f, 1e4f}};
  wall.triangle = {{0, 1, 2}, {0, 2, 3}};
  Surface black;
  black.base_colour = {};
  const LitScene shaded(with_surface(wall, black), map);
  CHECK(irradiance_of(shaded, {0, 0, 0}, {0, 1, 0}, many_rays(1024)).x == 0);
  CHECK(std::abs(irradiance_of(shaded, {0.002f, 0, 0}, {0, 1, 0}, many_rays(1024)).x / expected - 1) < 0.01f);

  const LitScene grey(with_surface(wall, black), uniform_sky({1, 1, 1}));
  CHECK(std::abs(irradiance_of(grey, {0, 0, 0}, {0, 1, 0}, many_rays(16384)).x / (pi / 2) - 1) < 0.02f);
}

TEST_CASE("a diffuse square overhead lights by its form factor") {
  // Lit from the side that is seen: an emitter would be the same as the sky's light reflected once by a large
  // bright floor.
  Surface lamp;
  lamp.base_colour = {};
  lamp.emission = {1, 1, 1};
  const LitScene scene(with_surface(square_overhead(1, 2), lamp), uniform_sky({0, 0, 0}));
  const float x = 0.5f, root = std::sqrt(1 + x * x);
  const float form_factor = 4 / (2 * pi) * 2 * x / root * std::atan(x / root);
  CHECK(std::abs(irradiance_of(scene, {0, 0, 0}, {0, 1, 0}, many_rays(16384)).x / (pi * form_factor) - 1) <
        0.03f);
}

TEST_CASE("irradiance does not depend on the number of threads, and progress can cancel") {
  Surface surface;
  const LitScene scene(with_surface(sphere_soup({0, 2, 0}, 1, 16), surface), uniform_sky({1, 0.5f, 0.25f}));
  std::vector<Vec3> position, normal;
  for (int i = 0; i < 1000; ++i) {
    position.push_back({0.002f * float(i), 0, 0});
    normal.push_back({0, 1, 0});
  }
  const Receivers receivers{position, normal};
  std::vector<Vec3> one;
  {
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    one = trace_irradiance(scene, receivers, many_rays(16));
  }
  CHECK(one == trace_irradiance(scene, receivers, many_rays(16)));
  CHECK_THROWS(
      trace_irradiance(scene, receivers, many_rays(16), [](std::size_t, std::size_t) { return false; }));
}
