// A model and a scene as a host uses them: what they describe, what changes a frame, and what is logged.
#include <nook/experimental/nook_debug.h>

#include <algorithm>

#include "tests/abi/host.h"
#include "tests/catch.h"

using namespace nook::test;

std::vector<std::byte> nook_test_model_bytes() {
  return Host().bytes;
}

namespace {

std::vector<float> read(const Stage& stage, nook_channel channel, std::size_t parts) {
  const std::uint32_t count = stage.info.file_vertex_count;
  std::vector<float> out(parts * count);
  REQUIRE(nook_scene_read(stage.scene, stage.first, channel, NOOK_FORMAT_FLOAT, out.data(), count, 0) ==
          NOOK_OK);
  return out;
}

std::vector<float> updated_ao(const Stage& stage) {
  REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
  return read(stage, NOOK_CHANNEL_AO, 1);
}

nook_scene_info info_of(nook_scene scene) {
  nook_scene_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_scene_describe(scene, &info) == NOOK_OK);
  return info;
}

}  // namespace

TEST_CASE("a model describes its sizes, its primitives and its bones") {
  Stage stage;
  const nook_model_info& info = stage.info;
  CHECK(info.file_vertex_count >= info.vertex_count);
  CHECK(info.lod_count >= 1);
  CHECK(info.model_bytes > 0);
  CHECK(info.lit_instance_bytes > info.instance_bytes);
  nook_range range{9, 0};
  CHECK(nook_model_describe_primitive(stage.model, 0, &range) == NOOK_OK);
  CHECK(range.first == 0);
  CHECK(range.count > 0);
  CHECK(nook_model_bone_name(stage.model, info.bone_count) == nullptr);
  CHECK(nook_model_read(stage.model, NOOK_MODEL_STATIC_AO, stage.ao.data(), info.file_vertex_count, 0) ==
        NOOK_OK);
  for (const float ao : stage.ao) CHECK((ao >= 0 && ao <= 1));
}

TEST_CASE("a scene counts its parts, and takes links, terms and models back") {
  Stage stage;
  REQUIRE(set_rows(stage.scene, stage.first, stage.pose.data(), stage.info.bone_count) == NOOK_OK);
  const std::vector<float> alone = updated_ao(stage);
  REQUIRE(nook_scene_link(stage.scene, stage.first, stage.second) == NOOK_OK);
  const std::vector<float> linked = updated_ao(stage);
  CHECK(linked != alone);
  REQUIRE(nook_scene_set_terms(stage.scene, NOOK_TERM_SELF) == NOOK_OK);
  CHECK(updated_ao(stage) == alone);
  REQUIRE(nook_scene_set_terms(stage.scene, NOOK_TERM_SELF | NOOK_TERM_LINKS) == NOOK_OK);
  REQUIRE(nook_scene_set_model(stage.scene, stage.first, stage.model) == NOOK_OK);
  CHECK(updated_ao(stage) == linked);
  REQUIRE(nook_scene_unlink(stage.scene, stage.first, stage.second) == NOOK_OK);
  CHECK(updated_ao(stage) == alone);
  REQUIRE(nook_scene_link_nearest(stage.scene, 4, 10) == NOOK_OK);
  REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
  const nook_scene_info info = info_of(stage.scene);
  CHECK(info.instances == 2);
  CHECK(info.instances_updated == 2);
  CHECK(info.links == 2);
  CHECK(info.evaluations > 0);
  CHECK(info.memory_bytes > 2 * stage.info.instance_bytes);
  REQUIRE(nook_scene_remove_instance(stage.scene, stage.second) == NOOK_OK);
  REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
  CHECK(info_of(stage.scene).instances == 1);
}

TEST_CASE("AO of a light is three numbers in [0, 1] for each vertex") {
  Stage stage;
  const nook_lobe lobe{{0, 1, 0}, 2, {1, 1, 1}, 0};
  REQUIRE(nook_scene_set_light(stage.scene, stage.first, &lobe, 1) == NOOK_OK);
  REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
  const std::vector<float> colour = read(stage, NOOK_CHANNEL_DIRECTIONAL_AO, 3);
  float darkest = 1;
  for (const float ao : colour) {
    CHECK((ao >= 0 && ao <= 1));
    darkest = std::min(darkest, ao);
  }
  CHECK(darkest < 1);
}

TEST_CASE("a context tells its log of what it makes") {
  Host host;
  int lines = 0;
  nook_context_desc desc = host.context_desc();
  desc.log_user = &lines;
  desc.log = [](void* user, nook_log_severity severity, const char* text) {
    *static_cast<int*>(user) += severity == NOOK_LOG_INFO && *text != 0;
  };
  nook_context context = nullptr;
  nook_model model = nullptr;
  REQUIRE(nook_context_create(&desc, &context) == NOOK_OK);
  REQUIRE(nook_model_load(context, host.bytes.data(), host.bytes.size(), &model) == NOOK_OK);
  CHECK(lines > 0);
  nook_model_destroy(&model);
  nook_context_destroy(&context);
}
