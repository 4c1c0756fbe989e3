// Grids against path tracing: where they are measured, planted errors, and probes inside solids.
#include "bakers/measure/probe/grid_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/probe/grid_bake.h"
#include "bakers/probe/inside_probes.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/probe/small_maps.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::probe;
using namespace nook::test;
using nook::probe::Grid;
using nook::probe::Probes;

namespace {

constexpr double pi = std::numbers::pi;

// A cube round the origin, its faces outwards.
TriangleSoup cube(float half) {
  TriangleSoup soup;
  for (int i = 0; i < 8; ++i)
    soup.position.push_back({i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half});
  soup.triangle = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return soup;
}

LitTriangles grey(TriangleSoup soup) {
  LitTriangles lit{std::move(soup), {Surface{}}};
  lit.triangle_surface.assign(lit.soup.triangle.size(), 0);
  return lit;
}

Environment white_sky() {
  return map_of(8, 4, [](Vec3) { return Vec3{1, 1, 1}; });
}

// Probes that see this radiance everywhere.
Probes constant_probes(const Grid& grid, float radiance) {
  Probes probes;
  probes.basis = nook::probe::harmonic_basis(1);
  probes.grid = grid;
  probes.coefficients.assign(grid.size() * probes.basis.count, Vec3{});
  const float first = radiance * float(std::sqrt(4 * pi));
  for (std::size_t p = 0; p < grid.size(); ++p)
    probes.coefficients[p * probes.basis.count] = {first, first, first};
  return probes;
}

}  // namespace

TEST_CASE("a grid's error is what was planted") {
  const LitScene scene({}, white_sky());
  const Grid grid = grid_in_box({2, 2, 2}, {-1, -1, -1}, {1, 1, 1});
  const Places places = places_in_the_open(scene, grid, 200, 5);
  REQUIRE(places.normal.size() == 200);
  for (const Vec3 p : places.position_ws)
    CHECK((std::abs(p.x) <= 1 && std::abs(p.y) <= 1 && std::abs(p.z) <= 1));
  const GridError right = grid_error(scene, constant_probes(grid, 1), places, 1024, 1, {});
  // 1,024 paths of a standard deviation of a third of the mean, 200 places.
  CHECK(std::abs(right.mean / pi - 1) < 0.004);
  CHECK(std::abs(right.noise / pi - 0.01) < 0.004);
  CHECK(right.rms / pi < 0.005);
  const GridError wrong = grid_error(scene, constant_probes(grid, 1.2f), places, 1024, 1, {});
  CHECK(std::abs(wrong.rms / pi - 0.2) < 0.005);
  CHECK(std::abs(wrong.bias / pi - 0.2) < 0.005);
  CHECK(wrong.worst / pi > 0.2);
  CHECK(wrong.worst / pi < 0.25);
}

TEST_CASE("places on surfaces share the area in the grid's box, and face its probes") {
  // A floor, a wall half as large, both in the box, and a large floor far below.
  TriangleSoup soup;
  soup.position = {{-1, 0, -1}, {1, 0, -1},   {1, 0, 1},   {-1, 0, 1}, {-1, 1, -1},
                   {1, 1, -1},  {-9, -9, -9}, {9, -9, -9}, {9, -9, 9}};
  soup.triangle = {{0, 1, 2}, {0, 2, 3}, {0, 1, 5}, {0, 5, 4}, {6, 7, 8}};
  const Grid grid = grid_in_box({3, 2, 3}, {-1, 0, -1}, {1, 2, 1});
  const LitScene scene(grey(soup), white_sky());
  const Places places = places_on_surfaces(scene, soup, grid, std::vector<bool>(18), 1e-4f, 600, 3);
  int on_floor = 0, left = 0;
  for (std::size_t i = 0; i < 600; ++i) {
    const Vec3 p = places.position_ws[i], n = places.normal[i];
    const bool floor = n.y == 1;
    CHECK((floor ? p.y == 0 : std::abs(p.z + 1) < 1e-6f && n.z == 1));
    on_floor += floor;
    left += p.x < 0;
  }
  CHECK(std::abs(on_floor - 400) < 50);  // four standard deviations
  CHECK(std::abs(left - 300) < 50);
  const Grid elsewhere = grid_in_box({2, 2, 2}, {50, 50, 50}, {51, 51, 51});
  CHECK_THROWS_AS(places_on_surfaces(scene, soup, elsewhere, std::vector<bool>(8), 1e-4f, 4, 3), Failure);
  // A solid is seen from outside, also where the nearest probe lies behind the tangent plane.
  const LitScene block(grey(cube(0.5f)), white_sky());
  const Places round = places_on_surfaces(block, cube(0.5f), grid_in_box({2, 1, 1}, {-2, -2, -2}, {2, 2, 2}),
                                          std::vector<bool>(2), 1e-4f, 64, 3);
  for (std::size_t i = 0; i < 64; ++i) CHECK(dot(round.position_ws[i], round.normal[i]) > 0.49f);
  const LitScene solid(grey(cube(1)), white_sky());
  CHECK_THROWS_AS(
      places_in_the_open(solid, grid_in_box({1, 1, 1}, {-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}), 4, 3),
      Failure);
}

TEST_CASE("probes are looked up off the surface by an option") {
  // A floor between a dark layer of probes and a bright one.
  TriangleSoup floor;
  floor.position = {{-9, 0, -9}, {9, 0, 9}, {9, 0, -9}};
  floor.triangle = {{0, 1, 2}};
  const LitScene scene(grey(floor), white_sky());
  Probes probes = constant_probes(grid_in_box({1, 2, 1}, {-1, -1, -1}, {1, 1, 1}), 1);
  probes.coefficients[0] = {};
  Places places{{{0.2f, 0, 0}, {-0.2f, 0, 0}}, {{0, 1, 0}, {0, 1, 0}}};
  CHECK(std::abs(grid_error(scene, probes, places, 1024, 1, {}).bias / pi + 0.5) < 0.03);
  places.lookup_offset = 0.5f;
  CHECK(std::abs(grid_error(scene, probes, places, 1024, 1, {}).bias / pi) < 0.03);
}

TEST_CASE("probes inside a solid are found, and take the light of those round it") {
  const LitScene scene(grey(cube(0.6f)), white_sky());
  GridBakeSettings settings;
  settings.basis = nook::probe::harmonic_basis(1);
  settings.fit.method = nook::probe::FitMethod::least_squares;
  settings.grid = grid_in_box({3, 3, 3}, {-1.5f, -1.5f, -1.5f}, {1.5f, 1.5f, 1.5f});
  const std::vector<bool> inside = inside_probes(scene, settings.grid);
  for (std::size_t p = 0; p < 27; ++p) CHECK(inside[p] == (p == 13));
  GridBake bake(scene, settings);
  for (int pass = 0; pass < 8; ++pass) bake.pass();
  CHECK(bake.inside_count() == 1);
  const Probes probes = bake.probes();
  Vec3 mean;
  for (const std::size_t p : {4u, 10u, 12u, 14u, 16u, 22u}) mean += probes.of(p)[0] * (1.0f / 6);
  CHECK(length(probes.of(13)[0] - mean) < 1e-5f * length(mean));
  // Walls that face inwards, or a file whose order of vertices says nothing: no probe is inside.
  const LitScene room(grey(cube(5)), white_sky());
  const std::vector<bool> none = inside_probes(room, settings.grid);
  CHECK(std::count(none.begin(), none.end(), true) == 0);
}

TEST_CASE("layers of probes inside are filled from outside inwards") {
  Grid grid;
  grid.counts = {5, 1, 1};
  Probes probes = constant_probes(grid, 1);
  const std::size_t count = probes.basis.count;
  probes.coefficients[0] = {1, 0, 0};
  probes.coefficients[4 * count] = {5, 0, 0};
  fill_inside(probes, {false, true, true, true, false});
  CHECK(probes.of(1)[0] == Vec3{1, 0, 0});
  CHECK(probes.of(2)[0] == Vec3{3, 0, 0});
  CHECK(probes.of(3)[0] == Vec3{5, 0, 0});
  fill_inside(probes, std::vector<bool>(5, true));  // nothing to take from
  CHECK(probes.of(2)[0] == Vec3{3, 0, 0});
}
