// Grids of probes against closed forms and the path tracer's own irradiance.
#include "bakers/probe/grid_bake.h"

#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "bakers/measure/probe/fit_error.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/probe/probe_file.h"
#include "sdk/src/probe/probe_light.h"
#include "tests/bakers/probe/small_maps.h"
#include "tests/bakers/raytrace/sphere_soup.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::probe;
using namespace nook::test;
using nook::probe::FitMethod;
using nook::probe::Probes;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

LitTriangles with_surface(TriangleSoup soup, const Surface& surface) {
  LitTriangles lit{std::move(soup), {surface}, {}};
  lit.triangle_surface.assign(lit.soup.triangle.size(), 0);
  return lit;
}

GridBakeSettings grid_of(const Basis& basis, FitMethod method, std::array<std::uint32_t, 3> counts, Vec3 low,
                         Vec3 high) {
  GridBakeSettings settings;
  settings.basis = basis;
  settings.fit.method = method;
  settings.fit.constraint = nook::probe::Constraint::none;
  settings.grid = grid_in_box(counts, low, high);
  return settings;
}

Vec3 irradiance_at(const Probes& probes, Vec3 position, Vec3 normal) {
  std::vector<Vec3> b(probes.basis.count);
  nook::probe::interpolate(probes, position, b);
  return nook::probe::irradiance(probes.basis, b, nook::probe::IrradianceForm::bands, normal);
}

}  // namespace

TEST_CASE("probes stand at the centres of the cells of a box") {
  const nook::probe::Grid grid = grid_in_box({4, 2, 1}, {-2, 0, 5}, {2, 3, 5});
  CHECK(grid.origin_ws.x == -1.5f);
  CHECK(grid.origin_ws.y == 0.75f);
  CHECK(grid.spacing_ws.x == 1);
  CHECK(grid.spacing_ws.y == 1.5f);
  CHECK(grid.spacing_ws.z > 0);  // a flat box
}

TEST_CASE("probes under an open sky equal the probes of the map") {
  const Environment map = uneven_map();
  const Basis basis = nook::probe::vogel_basis(9);
  const ExactFit exact(map, basis);
  const LitScene scene({}, map);
  GridBake bake(scene, grid_of(basis, FitMethod::least_squares, {2, 1, 2}, {0, 0, 0}, {1, 1, 1}));
  for (int pass = 0; pass < 256; ++pass) bake.pass();
  CHECK(bake.samples() == 16384);
  const Probes probes = bake.probes();
  // 16,384 samples, half of them by luminance, 9 unknowns: 1e-3 of the residual's variance is usual.
  for (std::size_t p = 0; p < 4; ++p) CHECK(exact.excess(probes.of(p)) < 0.01);
  CHECK(probes.of(0)[0].x != probes.of(1)[0].x);  // each has samples of its own
  const Probes back =
      nook::probe::read_probes(nook::probe::write_probes(probes, nook::probe::Packing::float32));
  CHECK(back.grid == probes.grid);
  CHECK(back.of(3)[2] == probes.of(3)[2]);
}

TEST_CASE("probes in a room whose walls shine see emission / (1 - base colour) everywhere") {
  Surface lamp;
  lamp.base_colour = {0.5f, 0.75f, 0};
  lamp.emission = {1, 1, 1};
  const LitScene room(with_surface(sphere_soup({0, 0, 0}, 1, 24), lamp), uneven_map());
  GridBakeSettings settings = grid_of(nook::probe::vogel_basis(6, true), FitMethod::running_average,
                                      {2, 2, 1}, {-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f});
  settings.path.origin_offset = 1e-3f;
  GridBake bake(room, settings);
  for (int pass = 0; pass < 128; ++pass) bake.pass();
  const Probes probes = bake.probes();
  for (std::size_t p = 0; p < 4; ++p) {
    const Vec3 e =
        nook::probe::irradiance(probes.basis, probes.of(p), nook::probe::IrradianceForm::bands, {0, 0, 1});
    // Paths end by roulette: a standard deviation of about 1 each, over 8,192 paths that 7 functions share;
    // Hill's fit 1 %.
    CHECK(std::abs(e.x / (2 * pi) - 1) < 0.05f);
    CHECK(std::abs(e.y / (4 * pi) - 1) < 0.08f);
    CHECK(std::abs(e.z / pi - 1) < 0.02f);
  }
}

TEST_CASE("irradiance of a grid is near the path tracer's own") {
  // A grey box floor below and a wall at one side, under a sky that is bright on the other.
  TriangleSoup soup;
  soup.position = {{-3, 0, -3}, {3, 0, -3}, {3, 0, 3}, {-3, 0, 3}, {3, 4, -3}, {3, 4, 3}};
  soup.triangle = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}, {4, 5, 2}};
  Surface grey;
  grey.base_colour = {0.5f, 0.5f, 0.5f};
  const LitScene scene(with_surface(soup, grey), map_of(64, 32, [](Vec3 d) {
                         return d.x < -0.5f ? Vec3{4, 3, 2} : Vec3{0.5f, 0.6f, 1};
                       }));
  GridBake bake(scene, grid_of(nook::probe::harmonic_basis(2), FitMethod::least_squares, {1, 1, 1},
                               {0, 0.5f, 0}, {1, 1.5f, 1}));
  for (int pass = 0; pass < 256; ++pass) bake.pass();
  const Probes probes = bake.probes();
  const Vec3 at{0.5f, 1, 0.5f};
  const std::vector<Vec3> positions(4, at), normals{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  IrradianceSettings truth;
  truth.rays = 4096;
  truth.path.origin_offset = 0;  // nothing is there
  const std::vector<Vec3> traced = trace_irradiance(scene, {positions, normals}, truth);
  const float largest = traced[1].x;  // towards the bright side
  for (std::size_t n = 0; n < 4; ++n) {
    const Vec3 e = irradiance_at(probes, at, normals[n]);
    // Three bands leave out a few percent of the largest irradiance (R. Ramamoorthi & P. Hanrahan 2001); the
    // rest is noise below 2 %.
    CHECK(std::abs(e.x - traced[n].x) < 0.05f * largest);
    CHECK(std::abs(e.z - traced[n].z) < 0.05f * largest);
  }
}

TEST_CASE("the stated error is the error, and falls with the root of the samples") {
  const Environment map = uneven_map();
  const Basis basis = nook::probe::vogel_basis(9);
  const ExactFit exact(map, basis);
  const LitScene scene({}, map);
  for (FitMethod method : {FitMethod::least_squares, FitMethod::running_average}) {
    GridBake bake(scene, grid_of(basis, method, {4, 4, 2}, {0, 0, 0}, {1, 1, 1}));
    CHECK(bake.error() == 1);
    double before = 0;
    for (std::uint32_t passes : {32u, 128u}) {
      while (bake.passes() < passes) bake.pass();
      const Probes probes = bake.probes();
      double distance = 0;
      for (std::size_t p = 0; p < 32; ++p) distance += exact.distance(probes.of(p)) / 32;
      // 32 probes of 27 numbers: the estimate itself scatters by some percent. The running average also has a
      // bias, which two halves of it share.
      CHECK(std::abs(bake.error() / std::sqrt(distance) - 1) < 0.35);
      if (before > 0) CHECK(std::abs(before / bake.error() - 2) < 0.5);
      before = bake.error();
    }
  }
}

TEST_CASE("a grid is the same on any number of threads") {
  const LitScene scene(with_surface(sphere_soup({0, 0, 0}, 1, 8), {}), uneven_map());
  const GridBakeSettings settings =
      grid_of(nook::probe::vogel_basis(12), FitMethod::running_average, {3, 3, 3}, {-2, -2, -2}, {2, 2, 2});
  const auto bake_all = [&] {
    GridBake bake(scene, settings);
    for (int pass = 0; pass < 4; ++pass) bake.pass();
    const Probes probes = bake.probes();
    return std::vector<Vec3>(probes.coefficients.begin(), probes.coefficients.end());
  };
  std::vector<Vec3> one;
  {
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    one = bake_all();
  }
  CHECK(one == bake_all());
  GridBakeSettings none = settings;
  none.grid.counts[1] = 0;
  CHECK_THROWS_AS(GridBake(scene, none), Failure);
}
