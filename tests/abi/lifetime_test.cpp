// Memory: each allocation refused in turn, none in a frame, any order of destruction, threads.
#include <algorithm>
#include <string>
#include <thread>

#include "tests/abi/host.h"
#include "tests/catch.h"

using namespace nook::test;

namespace {

// Builds, runs and tears down everything that allocates; returns the first failure and goes on to the end.
nook_result run_everything(Host& host) {
  nook_result first_failure = NOOK_OK;
  const auto note = [&](nook_result result) {
    if (first_failure == NOOK_OK) first_failure = result;
    return result == NOOK_OK;
  };
  const nook_context_desc desc = host.context_desc();
  const nook_scene_desc scene_desc = Host::scene_desc();
  nook_context context = nullptr;
  nook_model model = nullptr;
  nook_scene scene = nullptr;
  nook_instance_id a = 0, b = 0;
  nook_occluder_id occluder = 0;
  const nook_occluder ball{{0, 1, 0}, 0.3f, 0};
  if (note(nook_context_create(&desc, &context)) &&
      note(nook_model_load(context, host.bytes.data(), host.bytes.size(), &model)) &&
      note(nook_scene_create(context, &scene_desc, &scene)) &&
      note(nook_scene_add_instance(scene, model, &a)) && note(nook_scene_add_instance(scene, model, &b)) &&
      note(nook_scene_link(scene, a, b)) && note(nook_scene_link_nearest(scene, 4, 10)) &&
      note(nook_scene_add_occluder(scene, &ball, &occluder)) &&
      note(nook_scene_add_occluder(scene, &ball, &occluder)) && note(nook_scene_remove_instance(scene, b)) &&
      note(nook_scene_add_instance(scene, model, &b))) {
  }
  // Whatever there is still works.
  if (scene && nook_scene_update(scene) != NOOK_OK) first_failure = NOOK_ERROR_INTERNAL;
  nook_scene_destroy(&scene);
  nook_model_destroy(&model);
  nook_context_destroy(&context);
  return first_failure;
}

}  // namespace

TEST_CASE("each allocation refused in turn is one clean failure") {
  Host plain;
  REQUIRE(run_everything(plain) == NOOK_OK);
  const int total = plain.allocations;
  REQUIRE(total > 20);
  for (int n = 0; n < total; ++n) {
    Host host;
    host.refuse_at = n;
    const nook_result result = run_everything(host);
    INFO("allocation " << n);
    CHECK(result == NOOK_ERROR_OUT_OF_MEMORY);
    CHECK(std::string(nook_last_message()).find("allocator returned NULL") != std::string::npos);
    CHECK(host.blocks == 0);
  }
}

TEST_CASE("a frame allocates nothing") {
  Stage stage;
  nook_occluder_id occluder = 0;
  const float centre[3] = {0, 1, 0}, plane[4] = {0, 1, 0, -1};
  REQUIRE(nook_scene_link(stage.scene, stage.first, stage.second) == NOOK_OK);
  REQUIRE(nook_scene_link_nearest(stage.scene, 16, 100) == NOOK_OK);
  const nook_occluder ball{{0, 1, 0}, 0.3f, 0};
  REQUIRE(nook_scene_add_occluder(stage.scene, &ball, &occluder) == NOOK_OK);
  std::vector<nook_instance_id> more(30);
  for (nook_instance_id& id : more)
    REQUIRE(nook_scene_add_instance(stage.scene, stage.model, &id) == NOOK_OK);
  const int before = stage.host.allocations;
  for (int frame = 0; frame < 3; ++frame) {
    for (std::size_t i = 0; i < more.size(); ++i) {
      for (std::size_t b = 0; b < stage.info.bone_count; ++b)
        stage.pose[12 * b + 3] = static_cast<float>(i * frame);
      REQUIRE(nook::test::set_rows(stage.scene, more[i], stage.pose.data(), stage.info.bone_count) ==
              NOOK_OK);
      REQUIRE(nook_scene_set_ground(stage.scene, more[i], plane) == NOOK_OK);
    }
    const nook_occluder larger{{0, 1, 0}, 0.4f, more[0]};
    REQUIRE(nook_scene_set_occluder(stage.scene, occluder, &larger) == NOOK_OK);
    REQUIRE(nook_scene_set_camera(stage.scene, centre) == NOOK_OK);
    REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
    REQUIRE(nook_scene_read(stage.scene, stage.first, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, stage.ao.data(),
                            stage.info.file_vertex_count, 0) == NOOK_OK);
  }
  CHECK(stage.host.allocations == before);
}

TEST_CASE("handles may be destroyed in any order, and again") {
  int order[3] = {0, 1, 2};
  do {
    Stage stage;
    for (const int which : order) {
      if (which == 0) nook_context_destroy(&stage.context);
      if (which == 1) nook_model_destroy(&stage.model);
      if (which == 2) nook_scene_destroy(&stage.scene);
      if (stage.scene) {
        // A scene keeps alive what it uses.
        CHECK(nook_scene_update(stage.scene) == NOOK_OK);
        CHECK(nook_scene_read(stage.scene, stage.first, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, stage.ao.data(),
                              stage.info.file_vertex_count, 0) == NOOK_OK);
      }
      if (stage.model) CHECK(nook_model_bone_name(stage.model, 0) != nullptr);
    }
    CHECK(stage.host.blocks == 0);
    nook_context_destroy(&stage.context);
    nook_model_destroy(&stage.model);
    nook_scene_destroy(&stage.scene);
  } while (std::next_permutation(order, order + 3));
  nook_scene_destroy(nullptr);
}

TEST_CASE("the name of a bone is valid while its model lives") {
  Stage stage;
  const char* const name = nook_model_bone_name(stage.model, 0);
  const std::string text = name;
  for (int i = 0; i < 20; ++i) {
    nook_model other = nullptr;
    REQUIRE(nook_model_load(stage.context, stage.host.bytes.data(), stage.host.bytes.size(), &other) ==
            NOOK_OK);
    REQUIRE(nook_scene_add_instance(stage.scene, other, &stage.second) == NOOK_OK);
    nook_model_destroy(&other);
  }
  nook_scene_destroy(&stage.scene);
  nook_context_destroy(&stage.context);
  CHECK(nook_model_bone_name(stage.model, 0) == name);
  CHECK(text == name);
}

TEST_CASE("the message of a failure is valid until the next failure of its thread") {
  Stage stage;
  REQUIRE(nook_scene_remove_instance(stage.scene, 12345) != NOOK_OK);
  const char* const message = nook_last_message();
  const std::string text = message;
  REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
  std::thread([] { nook_context_create(nullptr, nullptr); }).join();
  CHECK(nook_last_message() == message);
  CHECK(text == message);
}

TEST_CASE("threads read one scene, and run scenes of their own") {
  Stage stage;
  REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
  REQUIRE(nook_scene_read(stage.scene, stage.first, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, stage.ao.data(),
                          stage.info.file_vertex_count, 0) == NOOK_OK);
  std::atomic<int> wrong{0};
  const auto work = [&](int number) {
    std::vector<float> ao(stage.ao.size());
    const nook_scene_desc desc = Host::scene_desc();
    nook_scene own = nullptr;
    nook_instance_id id = 0;
    wrong += nook_scene_create(stage.context, &desc, &own) != NOOK_OK;
    wrong += nook_scene_add_instance(own, stage.model, &id) != NOOK_OK;
    for (int i = 0; i < 50; ++i) {
      wrong += nook_scene_read(stage.scene, stage.first, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao.data(),
                               stage.info.file_vertex_count, 0) != NOOK_OK;
      wrong += ao != stage.ao;
      wrong += nook_scene_update(own) != NOOK_OK;
      // Each thread has its own last message.
      nook_scene_remove_instance(own, 1000 + static_cast<std::uint32_t>(number));
      wrong += std::string(nook_last_message()).find(std::to_string(1000 + number)) == std::string::npos;
    }
    nook_scene_destroy(&own);
  };
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) threads.emplace_back(work, t);
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == 0);
}

TEST_CASE("two contexts keep their memory apart") {
  Stage one;
  Stage two;
  const int before = one.host.allocations;
  nook_instance_id id = 0;
  REQUIRE(nook_scene_add_instance(two.scene, two.model, &id) == NOOK_OK);
  CHECK(one.host.allocations == before);
  // A model of one context in a scene of another: each draws on its own, and both stay alive.
  REQUIRE(nook_scene_add_instance(two.scene, one.model, &id) == NOOK_OK);
  nook_model_destroy(&one.model);
  nook_scene_destroy(&one.scene);
  nook_context_destroy(&one.context);
  CHECK(nook_scene_update(two.scene) == NOOK_OK);
  CHECK(one.host.blocks > 0);
  nook_scene_destroy(&two.scene);
  CHECK(one.host.blocks == 0);
}
