#include "bakers/lab/crowd/selection.h"

#include <algorithm>
#include <cmath>

#include "tests/catch.h"

using namespace nook::lab::crowd;

TEST_CASE("neighbours, order by distance and the busiest place of a known crowd") {
  const std::vector<Place> crowd{{0, 0}, {0.8f, 0}, {-0.9f, 0}, {5, 0}};
  CHECK(with_neighbour_within(crowd, 1.0f) == std::vector<std::uint32_t>{0, 1, 2});
  CHECK(nearest_to(crowd, {5, 0}, 2) == std::vector<std::uint32_t>{3, 1});
  CHECK(busiest(crowd, 1.0f) == 0);
}

TEST_CASE("the sample has neighbours if the crowd has any, and is spread over the crowd") {
  std::vector<Place> pairs;
  for (int i = 0; i < 48; ++i) pairs.push_back({float(i / 2) * 10, float(i % 2) * 0.5f});
  pairs.push_back({0, -100});  // alone, and so never part of the sample
  const Sample sample = choose_sample(pairs);
  CHECK(sample.have_neighbours);
  CHECK(sample.characters == std::vector<std::uint32_t>{0, 4, 8, 12, 16, 20, 24, 28, 32, 36, 40, 44});

  const Sample alone = choose_sample(std::vector<Place>{{9, 0}, {3, 0}});
  CHECK_FALSE(alone.have_neighbours);
  CHECK(alone.characters == std::vector<std::uint32_t>{1, 0});
}

TEST_CASE("the group is seen from where nobody stands, and its floor holds all bodies") {
  // Three stand together, and a row stands towards +z.
  std::vector<Place> crowd{{0, 0}, {0.5f, 0}, {-0.5f, 0}};
  for (int i = 0; i < 4; ++i) crowd.push_back({0, 1.5f + float(i)});
  const Group group = choose_group(crowd);
  const glm::vec3 towards_eye = group.view.eye_ws - group.view.target_ws;
  CHECK(std::abs(std::atan2(towards_eye.x, towards_eye.z)) > 0.2f);
  for (const std::uint32_t member : {0u, 1u, 2u})
    CHECK(std::ranges::find(group.members, member) != group.members.end());
  const FloorPatch floor = floor_under(group, crowd, 0.5f, 10);
  constexpr float reach_m = 1.7f - 1e-4f;  // 1.2 m of body and 0.5 m of margin, but for rounding
  for (const std::uint32_t member : group.members) {
    CHECK(crowd[member].x - floor.low_x_m >= reach_m);
    CHECK(floor.low_x_m + floor.size_m - crowd[member].x >= reach_m);
    CHECK(crowd[member].y - floor.low_z_m >= reach_m);
    CHECK(floor.low_z_m + floor.size_m - crowd[member].y >= reach_m);
  }
}
