// Suns: what is one, what the sky keeps, and that both together are the light.
#include "bakers/raytrace/environment.h"

#include <cmath>

#include "bakers/raytrace/path_tracer.h"
#include "tests/bakers/probe/small_maps.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::test;

namespace {

// A sky of 1 with two suns: one in the middle of the map, one across its left and right border.
Environment two_suns() {
  Environment map = map_of(256, 128, [](Vec3) { return Vec3{1, 1, 1}; });
  std::vector<float> rgb(map.rgb().begin(), map.rgb().end());
  const auto put = [&](std::uint32_t row, std::uint32_t column, Vec3 light) {
    const std::size_t at = 3 * (std::size_t(row) * 256 + column);
    rgb[at] = light.x;
    rgb[at + 1] = light.y;
    rgb[at + 2] = light.z;
  };
  for (const std::uint32_t row : {40u, 41u}) {
    for (const std::uint32_t column : {128u, 129u}) put(row, column, {9000, 8000, 4000});
    for (const std::uint32_t column : {0u, 255u}) put(row, column, {1000, 1000, 1000});
  }
  return Environment(256, 128, std::move(rgb));
}

double light_of(const Environment& map) {
  double sum = 0;
  for (std::size_t i = 0; i < map.texel_count(); ++i)
    sum += double(map.texel(i).x) * map.solid_angle(std::uint32_t(i / map.width()));
  return sum;
}

}  // namespace

TEST_CASE("suns are found where they stand, with the light that the sky lacks") {
  const Environment map = two_suns(), sky = without_suns(map);
  const std::vector<Sun> suns = find_suns(map, 8);
  REQUIRE(suns.size() == 2);
  // The mean of the sky is 1, and of the cut suns' 8 texels of 32,768 a hundred times that: 1.02.
  CHECK(std::abs(sun_limit(map) - 102) < 2);
  CHECK(dot(suns[0].direction, map.direction(129, 40, 0.0f, 0.999f)) > 0.99999f);
  CHECK(dot(suns[1].direction, map.direction(0, 40, 0.0f, 0.999f)) > 0.99999f);
  CHECK(std::abs(suns[0].solid_angle - 4 * map.solid_angle(40)) < 0.03 * suns[0].solid_angle);
  CHECK(std::abs(light_of(map) - light_of(sky) - double(suns[0].irradiance.x + suns[1].irradiance.x)) <
        1e-4 * light_of(map));
  CHECK(find_suns(map, 1).size() == 1);
  // Without the brightest alone, the other one keeps its light.
  const Environment one = without_suns(map, 1);
  CHECK(std::abs(light_of(map) - light_of(one) - double(suns[0].irradiance.x)) < 1e-4 * light_of(map));
  CHECK(luminance(one.radiance(suns[1].direction)) > 900);
  // Both are even, so that the disc has the solid angle of the texels.
  CHECK(std::abs(suns[0].disc_solid_angle - suns[0].solid_angle) < 1e-3f * suns[0].solid_angle);
  for (std::size_t i = 0; i < sky.texel_count(); ++i) REQUIRE(luminance(sky.texel(i)) < 105);
}

TEST_CASE("glare round a sun hardly widens its disc") {
  // Texels of 200 in a circle of 6 degrees round one of 1e6; the disc of a texel, and of little more.
  const Vec3 towards = map_of(256, 128, [](Vec3) { return Vec3{}; }).direction(40, 60, 0.5f, 0.5f);
  const Environment map = map_of(256, 128, [&](Vec3 d) {
    const float cosine = dot(d, towards);
    return Vec3{1, 1, 1} * (cosine > 0.9999f ? 1e6f : cosine > 0.9945f ? 200.0f : 1.0f);
  });
  const std::vector<Sun> suns = find_suns(map, 8);
  REQUIRE(suns.size() == 1);
  CHECK(suns[0].solid_angle > 30 * map.solid_angle(60));
  CHECK(std::abs(suns[0].disc_solid_angle / map.solid_angle(60) - 1) < 0.05);
}

TEST_CASE("an even sky, a lamp that is broad, and no light at all have no sun") {
  CHECK(find_suns(map_of(64, 32, [](Vec3) { return Vec3{3, 2, 1}; }), 8).empty());
  // Three per cent of the sphere: its share of the mean is more than a hundredth of it.
  const Environment lamp = map_of(64, 32, [](Vec3 d) { return Vec3{1, 1, 1} * (d.y > 0.94f ? 1e4f : 1.0f); });
  CHECK(find_suns(lamp, 8).empty());
  CHECK(find_suns(Environment(4, 2, std::vector<float>(24)), 8).empty());
  CHECK(std::isfinite(sun_limit(Environment(4, 2, std::vector<float>(24)))));
}

TEST_CASE("direct light is the map's, its sky's or none; reflected light stays") {
  // A grey wall at x = 1 reflects the light of a sun and a sky to a point in front of it.
  TriangleSoup soup;
  soup.position = {{1, -50, -50}, {1, 50, -50}, {1, 0, 80}};
  soup.triangle = {{0, 1, 2}};
  LitTriangles lit{soup, {Surface{}}};
  lit.triangle_surface = {0};
  const LitScene scene(std::move(lit), two_suns());
  const auto irradiance = [&](Vec3 normal, DirectLight direct) {
    const Vec3 position{0, 0, 0};
    IrradianceSettings settings;
    settings.rays = 20000;
    settings.path.direct = direct;
    settings.path.origin_offset = 0;
    return double(trace_irradiance(scene, {{&position, 1}, {&normal, 1}}, settings)[0].x);
  };
  // Away from the wall: direct light alone.
  const Vec3 away{-1, 0, 0};
  const double all = irradiance(away, DirectLight::all), sky = irradiance(away, DirectLight::sky);
  CHECK(irradiance(away, DirectLight::none) == 0);
  CHECK(std::abs(sky / 3.14159 - 1) <
        0.08);  // a sky of 1, and a tenth of the sun at that side, which is half as much
  CHECK(all > 1.3 * sky);
  // To the wall, which fills most of the hemisphere: nearly all is reflected, the sun's light too.
  const Vec3 to_wall{1, 0, 0};
  const double reflected = irradiance(to_wall, DirectLight::none),
               both = irradiance(to_wall, DirectLight::all);
  CHECK(reflected > 0);
  CHECK(reflected > 0.9 * both);
  // A path that begins at a point sees the same.
  Random random(1);
  PathSettings settings;
  settings.direct = DirectLight::none;
  CHECK(trace_radiance(scene, {0, 0, 0}, {-1, 0, 0}, settings, random).x == 0);
  settings.direct = DirectLight::all;
  CHECK(trace_radiance(scene, {0, 0, 0}, {-1, 0, 0}, settings, random).x == 1);
}
