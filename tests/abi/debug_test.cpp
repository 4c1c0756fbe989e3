// Shapes for debug drawing through the public interface.
#include <nook/experimental/nook_debug.h>

#include <cstring>
#include <string>

#include "tests/abi/host.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::test;

TEST_CASE("shapes for debug drawing are as many as the instance describes") {
  Stage stage;
  REQUIRE(nook_scene_link(stage.scene, stage.first, stage.second) == NOOK_OK);
  REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
  nook_scene_instance_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_scene_describe_instance(stage.scene, stage.first, &info) == NOOK_OK);
  CHECK(info.level == 0);
  CHECK(info.updated == 1);
  CHECK(info.bound_radius > 0);
  constexpr std::uint32_t room = 64;
  nook_scene_sphere spheres[room];
  nook_scene_key_point points[room];
  nook_instance_id links[room];
  std::uint32_t count = room;
  REQUIRE(nook_scene_read_spheres(stage.scene, stage.first, spheres, &count) == NOOK_OK);
  CHECK(count == info.sphere_count);
  CHECK(spheres[0].radius > 0);
  count = room;
  REQUIRE(nook_scene_read_key_points(stage.scene, stage.first, points, &count) == NOOK_OK);
  REQUIRE(count == info.key_point_count);
  CHECK(points[count - 1].index == count - 1);
  count = room;
  REQUIRE(nook_scene_read_links(stage.scene, stage.first, links, &count) == NOOK_OK);
  REQUIRE(count == 1);
  CHECK(links[0] == stage.second);
}

TEST_CASE("shapes for debug drawing do not allocate") {
  Stage stage;
  REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
  const int before = stage.host.allocations;
  std::vector<nook_scene_sphere> spheres(stage.info.sphere_count);
  std::vector<nook_scene_key_point> points(stage.info.key_point_count);
  std::uint32_t count = stage.info.sphere_count;
  CHECK(nook_scene_read_spheres(stage.scene, stage.first, spheres.data(), &count) == NOOK_OK);
  count = stage.info.key_point_count;
  CHECK(nook_scene_read_key_points(stage.scene, stage.first, points.data(), &count) == NOOK_OK);
  CHECK(stage.host.allocations == before);
}

TEST_CASE("shapes for debug drawing refuse too little room and unknown instances") {
  Stage stage;
  std::vector<nook_scene_sphere> spheres(stage.info.sphere_count);
  std::uint32_t count = stage.info.sphere_count - 1;
  CHECK(nook_scene_read_spheres(stage.scene, stage.first, spheres.data(), &count) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(std::string(nook_last_message()) == "nook_scene_read_spheres: *count is too small (got 6, need 7)");
  CHECK(count == stage.info.sphere_count);
  CHECK(nook_scene_read_key_points(stage.scene, stage.first, nullptr, nullptr) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_scene_read_links(nullptr, stage.first, nullptr, &count) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_scene_read_links(stage.scene, 77, nullptr, &count) == NOOK_ERROR_INVALID_HANDLE);
  nook_scene_instance_info info{};
  CHECK(nook_scene_describe_instance(stage.scene, stage.first, &info) == NOOK_ERROR_INVALID_ARGUMENT);
}
