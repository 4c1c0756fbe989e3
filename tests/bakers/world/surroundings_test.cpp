#include "bakers/world/surroundings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/bakers/character/bending_tube.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

bool on_grid(float offset) {
  const float cells = offset / grid_step_m - 0.5f;
  return std::abs(cells - std::round(cells)) < 1e-2f;
}

}  // namespace

TEST_CASE("surroundings: the floor lies under the body, and its weights sum to its area") {
  const SkinnedMesh mesh = bending_tube();
  const SurfacePoints floor = floor_points(mesh.position, 400, 3);
  REQUIRE(floor.size() == 400);
  double area = 0;
  for (std::size_t i = 0; i < floor.size(); ++i) {
    area += double(floor.weight[i]);
    CHECK(floor.position[i].y == floor_height(mesh.position));
    CHECK(std::abs(floor.position[i].x - 0.5f) <= 0.5f * floor_size_m);
    CHECK(on_grid(floor.position[i].x - 0.5f));
    CHECK((floor.normal[i] == Vec3{0, 1, 0}));
  }
  CHECK(std::abs(area - double(floor_size_m) * double(floor_size_m)) < 1e-2);
}

TEST_CASE("surroundings: the contact ring is what lies near the body") {
  const SkinnedMesh mesh = bending_tube();
  const SurfacePoints ring = contact_points({mesh.position, mesh.triangle}, 5000, 1);
  // The tube lies along x from 0 to 1 m, its lowest line on the floor: the ring is a band of twice the reach
  // at the height of its points, 2 x 0.15 m wide at most.
  CHECK(ring.size() > 300);
  for (const Vec3 p : ring.position) {
    CHECK(std::abs(p.z) <= contact_m + 0.1f + grid_step_m);
    CHECK((p.x > -0.05f - contact_m - grid_step_m && p.x < 1.05f + contact_m + grid_step_m));
  }
}

TEST_CASE("surroundings: the wall keeps its distance, and faces the body") {
  const SkinnedMesh mesh = bending_tube();
  for (const float bearing : {0.0f, 1.0f, 4.0f}) {
    const Vec3 away{std::sin(bearing), 0, std::cos(bearing)};
    const SurfacePoints wall = wall_points(mesh.position, bearing, 200, 1);
    float nearest = -INFINITY;
    for (const Vec3 p : mesh.position) nearest = std::max(nearest, dot(p, away));
    for (std::size_t i = 0; i < wall.size(); ++i) {
      CHECK(std::abs(dot(wall.position[i], away) - nearest - wall_distance_m) < 1e-4f);
      CHECK((wall.normal[i] == -away));
      CHECK(wall.position[i].y >= floor_height(mesh.position));
    }
  }
}

TEST_CASE("surroundings: a neighbour stands apart on the same floor") {
  const SkinnedMesh mesh = bending_tube();
  const SurfacePoints other = neighbour_points(mesh.position, {mesh.position, mesh.triangle},
                                               0.5f * std::numbers::pi_v<float>, 300, 1);
  REQUIRE(other.size() == 300);
  float nearest = INFINITY;
  for (const Vec3 p : other.position) {
    nearest = std::min(nearest, p.x);
    CHECK(p.y >= floor_height(mesh.position) - 1e-4f);
  }
  // The body ends at x = 1.05 m.
  CHECK(nearest >= 1.05f + neighbour_gap_m - 1e-3f);
  CHECK(nearest < 1.05f + neighbour_gap_m + 0.1f);
}
