// The C++ wrapper. This file sees public headers only, as a host does.
#include <nook/nook.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "catch.h"

std::vector<std::byte> nook_test_model_bytes();

TEST_CASE("the C++ wrapper owns, moves and throws") {
  const std::vector<std::byte> bytes = nook_test_model_bytes();
  nook::Context context;
  nook::CharacterModel model(context, bytes.data(), bytes.size());
  nook::Scene scene(context);
  const nook_instance_id id = scene.add_instance(model);
  nook::Scene moved = std::move(scene);
  moved.update();
  std::vector<float> ao(model.info().file_vertex_count);
  moved.read_ao(id, ao.data(), static_cast<std::uint32_t>(ao.size()));
  CHECK(moved.stats().instances == 1);
  CHECK(model.bone_name(0) == "skeleton:bone_0");
  try {
    moved.remove_instance(999);
    FAIL("no exception");
  } catch (const nook::Error& error) {
    CHECK(error.result() == NOOK_ERROR_INVALID_HANDLE);
    CHECK(std::string(error.what()).find("999") != std::string::npos);
  }
}
