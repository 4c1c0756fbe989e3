// The model's file that a window follows, and bakes in the background.
#include <chrono>
#include <thread>

#include "platform/file_bytes.h"
#include "samples/crowd/model_bake.h"
#include "samples/crowd/model_file.h"
#include "tests/bakers/tool/glb_tube.h"
#include "tests/catch.h"

using namespace crowd;

TEST_CASE("a change of a model's file is taken once") {
  const std::filesystem::path path = std::filesystem::path(CROWD_OUT) / "followed.nook";
  std::filesystem::remove(path);
  ModelFile file(path);
  CHECK_FALSE(file.take_change());
  platform::write_file(path, "first", 5);
  CHECK(file.has_change());
  const auto first = file.take_change();
  REQUIRE(first);
  CHECK(std::string(first->begin(), first->end()) == "first");
  CHECK_FALSE(file.has_change());
  CHECK_FALSE(file.take_change());
  // Another size tells files apart whose times are equal.
  platform::write_file(path, "second", 6);
  const auto second = file.take_change();
  REQUIRE(second);
  CHECK(second->size() == 6);
  std::filesystem::remove(path);
  CHECK_FALSE(file.take_change());
}

TEST_CASE("a bake that is cancelled ends, and gives no model") {
  const std::string glb = glb_tube({"bend"});
  const Hero hero(std::span(reinterpret_cast<const unsigned char*>(glb.data()), glb.size()));
  ModelBake bake(hero, NOOK_BAKE_PRESET_PRODUCTION, 0);
  bake.cancel();
  while (!bake.is_done()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  try {
    bake.model();
    FAIL("a model of a cancelled bake");
  } catch (const BakeError& error) {
    CHECK(error.result() == NOOK_ERROR_CANCELLED);
  }
}
