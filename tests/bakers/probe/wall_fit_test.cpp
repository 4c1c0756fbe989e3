// Walls and coefficients that are fitted to path-traced light, against planted answers.
#include "bakers/probe/wall_fit.h"

#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "bakers/probe/grid_bake.h"
#include "bakers/probe/inside_probes.h"
#include "bakers/raytrace/random.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/probe/probe_light.h"
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

Probes dark_grid(const Grid& grid) {
  Probes probes;
  probes.basis = nook::probe::harmonic_basis(2);
  probes.grid = grid;
  probes.coefficients.assign(grid.size() * probes.basis.count, Vec3{});
  return probes;
}

// Constant radiance in the rooms before and behind x = 1.1.
constexpr float before = 1, behind = 0.02f;
Probes two_lights(const Grid& grid) {
  Probes probes = dark_grid(grid);
  for (std::size_t p = 0; p < grid.size(); ++p)
    probes.coefficients[p * probes.basis.count] =
        Vec3{1, 1, 1} * (float(std::sqrt(4 * pi)) * (grid.position_ws(p).x < 1.1f ? before : behind));
  return probes;
}

// Places on both faces of a wall from x = 1.1 to 1.2, on the floor, and in the air.
TrainingPlaces two_rooms(std::size_t count) {
  TrainingPlaces places;
  Random random(4);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t kind = i % 4;
    const float x = kind == 0   ? 1.1f
                    : kind == 1 ? 1.2f
                    : i % 8 < 4 ? random.between(0, 1.1f)
                                : random.between(1.2f, 2);
    const float y = kind == 2 ? 0 : random.between(0, 2), z = random.between(0, 2);
    places.position_ws.push_back({x, y, z});
    places.normal.push_back(kind == 0 ? Vec3{-1, 0, 0} : kind == 1 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
    places.on_surface.push_back(kind != 3);
    const float e = float(pi) * (x < 1.15f ? before : behind);
    places.irradiance.push_back({e, e, e});
  }
  return places;
}

float irradiance_at(const Probes& probes, Vec3 position, Vec3 normal) {
  std::vector<Vec3> b(probes.basis.count);
  nook::probe::interpolate(probes, position, normal, b);
  return nook::probe::irradiance(probes.basis, b, nook::probe::IrradianceForm::bands, normal).x;
}

// A room round the origin whose walls face inwards, with a solid in it.
LitTriangles cube(Vec3 centre, float half, bool inwards = false) {
  LitTriangles lit;
  for (int i = 0; i < 8; ++i)
    lit.soup.position.push_back(centre +
                                Vec3{i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half});
  lit.soup.triangle = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  if (inwards)
    for (auto& t : lit.soup.triangle) std::swap(t[0], t[1]);
  lit.surface.push_back(Surface{});
  lit.triangle_surface.assign(lit.soup.triangle.size(), 0);
  return lit;
}

}  // namespace

TEST_CASE("a wall between two lights is found, and nothing of one reaches the other") {
  const Grid grid = grid_in_box({2, 2, 2}, {0, 0, 0}, {2, 2, 2});
  Probes probes = two_lights(grid);
  CHECK(irradiance_at(probes, {1.25f, 0, 1}, {0, 1, 0}) > 10 * pi * behind);  // it leaks
  probes.walls = fit_walls(probes, two_rooms(200));
  REQUIRE(probes.walls.cell.size() == 1);
  for (const float z : {0.1f, 1.0f, 1.9f})
    for (const float away : {0.001f, 0.05f, 0.5f}) {
      CHECK(std::abs(irradiance_at(probes, {1.1f - away, 0, z}, {0, 1, 0}) / (pi * before) - 1) < 1e-5);
      CHECK(std::abs(irradiance_at(probes, {1.2f + away, 0, z}, {0, 1, 0}) / (pi * behind) - 1) < 1e-5);
    }
  CHECK(std::abs(irradiance_at(probes, {1.1f, 1, 1}, {-1, 0, 0}) / (pi * before) - 1) < 1e-5);
  CHECK(std::abs(irradiance_at(probes, {1.2f, 1, 1}, {1, 0, 0}) / (pi * behind) - 1) < 1e-5);
}

TEST_CASE("a cell with one light has no walls") {
  const Grid grid = grid_in_box({2, 2, 2}, {0, 0, 0}, {2, 2, 2});
  Probes probes = two_lights(grid);
  TrainingPlaces places = two_rooms(200);
  for (std::size_t p = 0; p < 8; ++p) probes.coefficients[9 * p] = probes.coefficients[0];
  places.irradiance.assign(places.size(), Vec3{1, 1, 1} * float(pi * before));
  CHECK(fit_walls(probes, places).cell[0].open());
  // Neither has one without places.
  CHECK(fit_walls(probes, {}).cell[0].open());
}

TEST_CASE("coefficients are found from irradiance alone") {
  const Grid grid = grid_in_box({3, 2, 2}, {0, 0, 0}, {3, 2, 2});
  Probes planted = dark_grid(grid);
  Random random(11);
  for (std::size_t i = 0; i < planted.coefficients.size(); ++i) {
    const float r = random.between(-1, 1), g = random.between(-1, 1);
    planted.coefficients[i] = Vec3{r, g, random.between(-1, 1)} + (i % 9 == 0 ? Vec3{8, 8, 8} : Vec3{});
  }
  TrainingPlaces places;
  for (int i = 0; i < 4000; ++i) {
    const float x = random.between(0, 3), y = random.between(0, 2), z = random.between(0, 2);
    const Vec3 n = normalised(Vec3{random.normal(), random.normal(), random.normal()});
    std::vector<Vec3> b(9);
    nook::probe::interpolate(planted, {x, y, z}, n, b);
    places.position_ws.push_back({x, y, z});
    places.normal.push_back(n);
    places.on_surface.push_back(1);
    places.irradiance.push_back(
        nook::probe::irradiance(planted.basis, b, nook::probe::IrradianceForm::bands, n));
  }
  Probes found = dark_grid(grid);
  fit_to_surfaces(found, places, {1e-6});
  // 4,000 places for 108 unknowns, solved to 1e-6 of the right side.
  for (std::size_t i = 0; i < found.coefficients.size(); ++i)
    CHECK(length(found.coefficients[i] - planted.coefficients[i]) < 0.01f);
  // Places without information leave the probes as they were.
  Probes same = planted;
  fit_to_surfaces(same, {});
  for (std::size_t i = 0; i < same.coefficients.size(); ++i)
    CHECK(length(same.coefficients[i] - planted.coefficients[i]) < 1e-6f);
  Probes lobes;
  lobes.basis = nook::probe::vogel_basis(6);
  lobes.coefficients.assign(6, {});
  CHECK_THROWS_AS(fit_to_surfaces(lobes, places), Failure);
}

TEST_CASE("probes that no light reaches stay dark where dim places use them") {
  const Grid grid = grid_in_box({2, 1, 1}, {0, 0, 0}, {2, 1, 1});
  Probes probes = dark_grid(grid);
  probes.coefficients[0] = Vec3{1, 1, 1} * float(std::sqrt(4 * pi));
  TrainingPlaces places;
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    places.position_ws.push_back({random.between(0.5f, 1.5f), 0, 0.5f});
    places.normal.push_back({0, 1, 0});
    places.on_surface.push_back(1);
    places.irradiance.push_back(Vec3{1, 1, 1} * float(2 * pi));  // twice the light of the lit probe
  }
  fit_to_surfaces(probes, places);
  for (std::size_t k = 0; k < 9; ++k) CHECK(probes.of(1)[k] == Vec3{});
  // The other probe took the light of the places.
  CHECK(probes.of(0)[0].x > 1.2f * float(std::sqrt(4 * pi)));
}

TEST_CASE("probes in a solid move out of it, and others stay") {
  const LitScene scene(cube({0.1f, 0, 0}, 0.3f), map_of(8, 4, [](Vec3) { return Vec3{1, 1, 1}; }));
  const Grid grid = grid_in_box({3, 3, 3}, {-1.5f, -1.5f, -1.5f}, {1.5f, 1.5f, 1.5f});
  const std::vector<Vec3> moved = moved_probes(scene, grid), plain = grid_probes(grid);
  for (std::size_t p = 0; p < 27; ++p)
    if (p != 13) CHECK(moved[p] == plain[p]);
  // Out of it by a tenth of the spacing, on the near side: x = -0.2 - 0.1 at most, in steps of 0.1125.
  CHECK(moved[13].x <= -0.3f);
  CHECK(moved[13].x > -0.45f);
  CHECK(moved[13].y == 0);
}

TEST_CASE("places to fit to lie on surfaces and in the air, the same on any number of threads") {
  const LitScene scene(cube({0, 0, 0}, 1, true), map_of(8, 4, [](Vec3) { return Vec3{1, 1, 1}; }));
  const Grid grid = grid_in_box({2, 2, 2}, {-1.01f, -1.01f, -1.01f}, {1.01f, 1.01f, 1.01f});
  TrainingSettings settings;
  settings.paths = 4;
  settings.path.origin_offset = 1e-3f;
  const TrainingPlaces places = training_places(scene, grid, settings);
  REQUIRE(places.size() > 100);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3 p = places.position_ws[i];
    const float edge = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    // The box reaches a hundredth beyond the room, where its walls have a second face.
    CHECK((places.on_surface[i] ? std::abs(edge - 1) < 1e-4f : edge < 1.011f));
    if (places.on_surface[i]) CHECK(std::abs(dot(p, places.normal[i])) > 0.99f);
  }
  const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
  const TrainingPlaces again = training_places(scene, grid, settings);
  CHECK(again.position_ws == places.position_ws);
  CHECK(again.irradiance == places.irradiance);
}
