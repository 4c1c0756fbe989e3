// Occluded directions against closed forms.
#include "bakers/character/vertex_fits.h"

#include <cmath>

#include "sdk/src/core/failure.h"
#include "tests/bakers/character/bending_tube.h"
#include "tests/bakers/character/patch_and_sphere.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

constexpr Mat3x4 turned{{0, 0, 1, 3, 1, 0, 0, -2, 0, 1, 0, 1}};

}  // namespace

TEST_CASE("a sphere over a point blocks the vector of its closed form, in any pose") {
  for (const Vec3 centre : {Vec3{0, 0, 2}, Vec3{1.5f, 0, 1.5f}, Vec3{-0.6f, 1.2f, 1}}) {
    const float radius = 0.8f;
    const SkinnedMesh mesh = patch_and_sphere(centre, radius);
    const Vec3 want = occluded_by_sphere(centre, radius, {0, 0, 1});
    for (const Mat3x4& bone : {Mat3x4{}, turned}) {
      const OccludedSample sample = trace_occluded(mesh, {bone}, {4096, 3});
      // Stratified rays: the error is some tenths of 1 / sqrt(rays), and the polyhedron covers 0.5 % too
      // little.
      CHECK(length(sample.occluded[0] - want) < 6e-3f);
      CHECK(std::abs(sample.ao[0] - ao_under_sphere(centre, radius, {0, 0, 1})) < 6e-3f);
    }
  }
}

TEST_CASE("a line over AO is recovered, and without observations the ends keep their prior") {
  const Vec3 dark{0.3f, -0.2f, 0.5f}, open{0.1f, 0.05f, -0.1f};
  OccludedLine planted;
  for (int i = 0; i < 200; ++i) {
    const float ao = float(i) / 199;
    planted.add(ao, (1 - ao) * dark + ao * open);
  }
  // The known observations weigh 0.1 against some 66 for each end.
  const OccludedEnds found = planted.ends({0, 0, 1});
  CHECK(length(found.dark - dark) < 2e-3f);
  CHECK(length(found.open - open) < 2e-3f);

  const OccludedEnds none = OccludedLine().ends({0, 1, 0});
  CHECK(length(none.dark - Vec3{0, 2.0f / 3, 0}) < 1e-6f);
  CHECK(length(none.open) < 1e-6f);

  OccludedLine steady;
  for (int i = 0; i < 50; ++i) steady.add(0.6f, {0.2f, 0, 0.1f});
  CHECK(length(steady.ends({0, 0, 1}).at(0.6f) - Vec3{0.2f, 0, 0.1f}) < 2e-3f);
}

TEST_CASE("a fit has the same bits for the same seed, and can be stopped") {
  const SkinnedMesh mesh = bending_tube();
  const std::vector<Pose> poses = tube_poses(mesh, 6);
  const auto once = fit_occluded(mesh, poses, {32, 5}), again = fit_occluded(mesh, poses, {32, 5});
  REQUIRE(once.size() == mesh.vertex_count());
  for (std::size_t v = 0; v < once.size(); ++v) {
    CHECK(once[v].dark == again[v].dark);
    CHECK(once[v].open == again[v].open);
  }
  CHECK_THROWS_AS(fit_occluded(mesh, poses, {32, 5}, [](std::size_t, std::size_t) { return false; }),
                  Failure);
  CHECK_THROWS_AS(fit_occluded(mesh, {}, {32, 5}), Failure);
}
