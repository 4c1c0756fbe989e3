// Shapes for debug drawing through the public interface.
#include <nook/experimental/nook_debug.h>

#include <cstring>
#include <string>

#include "tests/abi/host.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::test;

extern "C" int nook_debug_call_everything(nook_scene scene, nook_instance_id receiver,
                                          nook_instance_id caster);

TEST_CASE("every function of nook_debug.h works from C") {
  Stage stage;
  CHECK(nook_debug_call_everything(stage.scene, stage.first, stage.second) == 0);
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
