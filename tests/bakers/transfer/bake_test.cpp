// The bake of radiance transfer against closed forms of visibility.
#include <tbb/task_arena.h>

#include <cmath>

#include "bakers/import/surface_mesh.h"
#include "bakers/transfer/separated_bake.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/transfer/distant_light.h"
#include "sdk/src/transfer/transfer_file.h"
#include "tests/catch.h"
#include "tests/transfer/shapes.h"

using namespace nook;
using namespace nook::bake;
using nook::transfer::Transfer;
namespace shapes = nook::transfer::test;

namespace {

SurfaceMesh mesh_of(const shapes::Shape& shape) {
  return import_surface(shapes::glb_of(shape)).mesh;
}

std::vector<Vec3> axes_of(std::uint32_t lobes) {
  std::vector<Vec3> axes(lobes);
  nook::transfer::lobe_axes(axes);
  return axes;
}

nook_result result_of(const SurfaceMesh& mesh, const bake::transfer::BakeSettings& settings = {}) {
  try {
    bake::transfer::check_bake(mesh, settings);
    return NOOK_OK;
  } catch (const Failure& failure) {
    return failure.code();
  }
}

}  // namespace

TEST_CASE("over an open plane every lobe above the horizon is open") {
  const Transfer baked = bake::transfer::bake_transfer(mesh_of(shapes::plane(1, 3, 1)), {162, 32});
  const std::vector<Vec3> axes = axes_of(162);
  for (std::uint32_t v = 0; v < baked.vertex_count(); ++v)
    for (std::size_t j = 0; j < axes.size(); ++j) {
      if (axes[j].y > 0) CHECK(baked.shares_of(v)[j] == 255);
      if (axes[j].y < -0.6f) CHECK(baked.shares_of(v)[j] == 0);
    }
}

TEST_CASE("a ball over a plane hides the exact cap of each lobe") {
  // The middle vertex of the plane sees the ball as a cap of this half angle around this direction.
  const Vec3 centre{0.3f, 0.8f, 0.2f};
  constexpr float radius = 0.35f;
  shapes::Shape shape = shapes::plane(1, 3, 1);
  shapes::append(shape, shapes::ball(centre, radius, 96));
  constexpr std::uint32_t lobes = 162;
  const Transfer baked = bake::transfer::bake_transfer(mesh_of(shape), {lobes, 96});
  const Vec3 towards = normalised(centre);
  const float edge = std::sqrt(1 - radius * radius / dot(centre, centre));

  const nook::transfer::CubeCells cells(256);
  const std::vector<Vec3> axes = axes_of(lobes);
  std::vector<double> seen(lobes), whole(lobes);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Vec3 d = cells.direction[i];
    if (!(d.y > 0)) continue;
    for (std::size_t j = 0; j < lobes; ++j) {
      const double weight = double(gaussian_value(axes[j], nook::transfer::sharpness_of(lobes), d) * d.y *
                                   cells.solid_angle[i]);
      whole[j] += weight;
      if (dot(d, towards) < edge) seen[j] += weight;
    }
  }
  for (std::size_t j = 0; j < lobes; ++j) {
    if (axes[j].y < 0) continue;
    INFO("lobe " << j);
    // 55,296 directions sample the edge of the cap in steps of about a degree, a lobe is 8 degrees wide, and
    // a byte has steps of 0.004.
    CHECK(std::abs(double(baked.shares_of(4)[j]) / 255 - seen[j] / whole[j]) < 0.02);
  }
}

TEST_CASE("the bytes of a bake do not depend on the number of threads") {
  const SurfaceMesh mesh = mesh_of(shapes::draped_cloth());
  const auto bytes = [&](int threads) {
    std::vector<std::byte> out;
    tbb::task_arena arena(threads);
    arena.execute([&] {
      out = nook::transfer::write_transfer(bake::transfer::bake_transfer(mesh, {42, 8}));
    });
    return out;
  };
  CHECK(bytes(1) == bytes(3));
}

TEST_CASE("progress counts vertices and can cancel") {
  const SurfaceMesh mesh = mesh_of(shapes::knot_over_plane());
  std::size_t last = 0;
  bake::transfer::bake_transfer(mesh, {12, 8}, [&](std::size_t done, std::size_t total) {
    CHECK(done > last);
    CHECK(total == mesh.position.size());
    last = done;
    return true;
  });
  CHECK(last == mesh.position.size());
  try {
    bake::transfer::bake_transfer(mesh, {12, 8}, [](std::size_t, std::size_t) { return false; });
    FAIL("the bake was not cancelled");
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_CANCELLED);
  }
}

TEST_CASE("bad meshes and settings are refused at once") {
  const SurfaceMesh good = mesh_of(shapes::plane(1, 3, 1));
  CHECK(result_of(good) == NOOK_OK);
  constexpr nook_result invalid = NOOK_ERROR_INVALID_ARGUMENT;
  CHECK(result_of(good, {11, 32}) == invalid);
  CHECK(result_of(good, {2563, 32}) == invalid);
  CHECK(result_of(good, {642, 7}) == invalid);
  CHECK(result_of(good, {642, 32, 3}) == invalid);
  CHECK(result_of(good, {642, 32, 0, nullptr, NAN}) == invalid);
  CHECK(result_of({}) == invalid);
  SurfaceMesh bad = good;
  bad.position[2].y = NAN;
  CHECK(result_of(bad) == invalid);
  bad = good;
  bad.normal[1] = {0, 2, 0};
  CHECK(result_of(bad) == invalid);
  bad = good;
  bad.tangent[1].direction = {NAN, 0, 0};
  CHECK(result_of(bad) == invalid);
  bad = good;
  bad.uv[3].u = INFINITY;
  CHECK(result_of(bad) == invalid);
  bad = good;
  bad.uv.pop_back();
  CHECK(result_of(bad) == invalid);
  bad = good;
  bad.triangle[0][1] = 9;
  CHECK(result_of(bad) == invalid);
}
