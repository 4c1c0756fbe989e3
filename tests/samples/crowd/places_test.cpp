#include "samples/crowd/places.h"

#include <algorithm>
#include <cmath>

#include "tests/catch.h"

using namespace crowd;

namespace {

// Round bodies of 0.3 m: the needed distance between roots is known.
std::vector<Outline> round_bodies(float radius_m, std::size_t clips) {
  std::vector<Outline> outlines(clips);
  for (Outline& o : outlines) o.reach_m.fill(radius_m);
  return outlines;
}

float nearest_distance_m(const std::vector<Placement>& crowd) {
  float nearest = 1e9f;
  for (std::size_t i = 0; i < crowd.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      nearest = std::min(nearest, std::hypot(crowd[i].x_m - crowd[j].x_m, crowd[i].z_m - crowd[j].z_m));
  return nearest;
}

std::size_t count_with_neighbour(const std::vector<Placement>& crowd, float distance_m) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    bool near = false;
    for (std::size_t j = 0; j < crowd.size(); ++j)
      near = near ||
             (i != j && std::hypot(crowd[i].x_m - crowd[j].x_m, crowd[i].z_m - crowd[j].z_m) <= distance_m);
    found += near;
  }
  return found;
}

}  // namespace

TEST_CASE("a crowd has as many members as requested, close but not inside each other") {
  for (const std::uint32_t count : {1u, 2u, 7u, 100u}) {
    const std::vector<Placement> crowd = make_layout(round_bodies(0.3f, 5), count, 3);
    REQUIRE(crowd.size() == count);
    CHECK(nearest_distance_m(crowd) > 0.6f);
    if (count == 100) CHECK(count_with_neighbour(crowd, 1.0f) > 50);
  }
}

TEST_CASE("the seed decides the layout") {
  const auto outlines = round_bodies(0.3f, 3);
  const auto a = make_layout(outlines, 20, 1), b = make_layout(outlines, 20, 1),
             c = make_layout(outlines, 20, 2);
  bool same = true, other_same = true;
  for (std::size_t i = 0; i < a.size(); ++i) {
    same = same && a[i].x_m == b[i].x_m && a[i].phase == b[i].phase && a[i].clip == b[i].clip;
    other_same = other_same && a[i].x_m == c[i].x_m;
  }
  CHECK(same);
  CHECK_FALSE(other_same);
}
