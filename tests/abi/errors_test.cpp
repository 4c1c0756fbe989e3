// Every error code with its text, and every parameter out of its range.
#include <nook/experimental/nook_debug.h>
#include <algorithm>
#include <cmath>
#include <string>

#include "tests/abi/host.h"
#include "tests/catch.h"

using namespace nook::test;

namespace {

constexpr nook_result invalid = NOOK_ERROR_INVALID_ARGUMENT, no_handle = NOOK_ERROR_INVALID_HANDLE;

bool last_is(const char* start, const char* part) {
  const std::string text = nook_last_message();
  return text.rfind(start, 0) == 0 && text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("results have names") {
  CHECK(nook_result_name(NOOK_ERROR_INVALID_ARGUMENT) == std::string("NOOK_ERROR_INVALID_ARGUMENT"));
  CHECK(nook_result_name(NOOK_ERROR_INTERNAL) == std::string("NOOK_ERROR_INTERNAL"));
  CHECK(nook_result_name(1) == std::string("unknown result"));
  CHECK(nook_result_name(-99) == std::string("unknown result"));
}

TEST_CASE("context: bad parameters") {
  Stage stage;
  nook_context_desc desc = stage.host.context_desc();
  nook_context context = stage.context;
  CHECK(nook_context_create(nullptr, &context) == invalid);
  CHECK(context == nullptr);
  CHECK(nook_context_create(&desc, nullptr) == invalid);
  desc.allocator.release = nullptr;
  CHECK(nook_context_create(&desc, &context) == invalid);
  CHECK(last_is("nook_context_create: ", "only one of its two functions"));
}

TEST_CASE("models: bad parameters and bad files") {
  Stage stage;
  const auto& bytes = stage.host.bytes;
  nook_model model = stage.model;
  CHECK(nook_model_load(nullptr, bytes.data(), bytes.size(), &model) == invalid);
  CHECK(model == nullptr);
  CHECK(nook_model_load(stage.context, nullptr, 4, &model) == invalid);
  CHECK(nook_model_load(stage.context, bytes.data(), bytes.size(), nullptr) == invalid);
  CHECK(nook_model_load(stage.context, bytes.data(), bytes.size() - 1, &model) == NOOK_ERROR_BAD_FILE);
  CHECK(last_is("nook_model_load: ", "size is wrong"));
  auto newer = bytes;
  newer[8] = std::byte{9};
  CHECK(nook_model_load(stage.context, newer.data(), newer.size(), &model) == NOOK_ERROR_FILE_VERSION);
  CHECK(last_is("nook_model_load: ", "got 9, need 4"));

  nook_range range{};
  CHECK(nook_model_describe_primitive(stage.model, 2, &range) == invalid);
  CHECK(last_is("nook_model_describe_primitive: ", "got 2, need less than 2"));
  CHECK(nook_model_describe_primitive(nullptr, 0, &range) == invalid);
  CHECK(nook_model_describe_primitive(stage.model, 0, nullptr) == invalid);
  CHECK(nook_model_bone_name(nullptr, 0) == nullptr);
  CHECK(nook_model_describe(nullptr, &stage.info) == invalid);
  CHECK(nook_model_describe(stage.model, nullptr) == invalid);
  CHECK(nook_model_read(stage.model, NOOK_MODEL_STATIC_AO, stage.ao.data(), 3, 0) == invalid);
  CHECK(last_is("nook_model_read: ", "count is not"));
  CHECK(nook_model_read(stage.model, 2, stage.ao.data(), stage.info.file_vertex_count, 0) == invalid);
  CHECK(last_is("nook_model_read: ", "array is unknown"));
  CHECK(nook_model_read(stage.model, NOOK_MODEL_STATIC_AO, stage.ao.data(), stage.info.file_vertex_count,
                        3) == invalid);
  CHECK(last_is("nook_model_read: ", "stride is too small"));
  CHECK(nook_model_read(nullptr, NOOK_MODEL_STATIC_AO, stage.ao.data(), 3, 0) == invalid);
  CHECK(nook_model_read(stage.model, NOOK_MODEL_STATIC_AO, nullptr, stage.info.file_vertex_count, 0) ==
        invalid);

  nook::CharacterModel bare = sample_model();
  bare.static_ao.clear();
  const auto bare_bytes = nook::write_character_model(bare);
  REQUIRE(nook_model_load(stage.context, bare_bytes.data(), bare_bytes.size(), &model) == NOOK_OK);
  CHECK(nook_model_read(model, NOOK_MODEL_STATIC_AO, stage.ao.data(), stage.info.file_vertex_count, 0) ==
        NOOK_ERROR_UNSUPPORTED);
  nook_model_destroy(&model);
}

TEST_CASE("scenes: every field out of its range") {
  Stage stage;
  const auto refused = [&](auto&& damage, const char* field) {
    nook_scene_desc desc = Host::scene_desc();
    damage(desc);
    nook_scene scene = stage.scene;
    return nook_scene_create(stage.context, &desc, &scene) == invalid && scene == nullptr &&
           last_is("nook_scene_create: ", field);
  };
  CHECK(refused([](auto& d) { d.form = 2; }, "desc.form"));
  CHECK(refused([](auto& d) { d.form = -1; }, "desc.form"));
  CHECK(refused([](auto& d) { d.cutoff_error = NAN; }, "desc.cutoff_error"));
  CHECK(refused([](auto& d) { d.cutoff_error = 1.1f; }, "desc.cutoff_error"));
  CHECK(refused([](auto& d) { d.far_error = NAN; }, "desc.far_error"));
  CHECK(refused([](auto& d) { d.far_error = -1; }, "desc.far_error"));
  CHECK(refused([](auto& d) { d.lod_error = -1; }, "desc.lod_error"));
  CHECK(refused([](auto& d) { d.lod_distance = -1; }, "desc.lod_distance"));
  CHECK(refused([](auto& d) { d.lod_max_interval = 0; }, "desc.lod_max_interval"));
  CHECK(refused([](auto& d) { d.ground_radius = INFINITY; }, "desc.ground_radius"));
  CHECK(refused([](auto& d) { d.ground_radius = -1; }, "desc.ground_radius"));
  const nook_scene_desc good = Host::scene_desc();
  nook_scene scene = nullptr;
  CHECK(nook_scene_create(nullptr, &good, &scene) == invalid);
  CHECK(nook_scene_create(stage.context, &good, nullptr) == invalid);
}

TEST_CASE("contexts: instruction sets and units") {
  nook_context context = nullptr;
  nook_context_desc desc;
  REQUIRE(nook_context_desc_init(&desc) == NOOK_OK);
  for (const float wrong : {0.0f, -1.0f, NAN, INFINITY, 1e7f}) {
    desc.units_per_metre = wrong;
    CHECK(nook_context_create(&desc, &context) == invalid);
    CHECK(last_is("nook_context_create: ", "desc.units_per_metre"));
  }
  desc.units_per_metre = 1;
  // No machine has all instruction sets. What is missing is named, with those that are there.
  int unsupported = 0;
  for (nook_isa isa = NOOK_ISA_SCALAR;; ++isa) {
    desc.isa = isa;
    const nook_result result = nook_context_create(&desc, &context);
    CHECK((context != nullptr) == (result == NOOK_OK));
    nook_context_destroy(&context);
    if (result == NOOK_OK) continue;
    if (result == NOOK_ERROR_UNSUPPORTED) {
      CHECK(last_is("nook_context_create: ", "need one of scalar"));
      ++unsupported;
      continue;
    }
    CHECK((result == invalid && isa > NOOK_ISA_AVX512 &&
           last_is("nook_context_create: ", "desc.isa is unknown")));
    break;
  }
  CHECK(unsupported > 0);
  desc.isa = -1;
  CHECK(nook_context_create(&desc, &context) == invalid);
}

TEST_CASE("scenes: bad handles and parameters of every call") {
  Stage stage;
  nook_scene scene = stage.scene;
  const float far[3] = {0, NAN, 0};
  const float plane[4] = {0, 1, 0, INFINITY};
  nook_occluder_id occluder = 77;
  nook_instance_id id = 77;
  CHECK(nook_scene_add_instance(scene, nullptr, &id) == invalid);
  CHECK(id == 0);
  CHECK(nook_scene_add_instance(scene, stage.model, nullptr) == invalid);
  CHECK(nook_scene_add_instance(nullptr, stage.model, &id) == invalid);
  CHECK(nook_scene_remove_instance(scene, 0) == no_handle);
  CHECK(nook_scene_remove_instance(scene, 12345) == no_handle);
  CHECK(last_is("nook_scene_remove_instance: ", "no instance 12345"));
  CHECK(nook::test::set_rows(scene, 99, stage.pose.data(), stage.info.bone_count) == no_handle);
  CHECK(nook::test::set_rows(scene, stage.first, nullptr, stage.info.bone_count) == invalid);
  CHECK(nook::test::set_rows(scene, stage.first, stage.pose.data(), stage.info.bone_count - 1) == invalid);
  CHECK(last_is("nook_scene_set_pose: ", "got 4, need 5"));
  stage.pose[12 * 2 + 5] = NAN;
  CHECK(nook::test::set_rows(scene, stage.first, stage.pose.data(), stage.info.bone_count) == invalid);
  CHECK(last_is("nook_scene_set_pose: ", "bone 2"));
  // The axes x and y have unit length and the cosine 0.1 between them.
  const float sheared[12] = {1, 0.1f, 0, 0, 0, 0.99498744f, 0, 0, 0, 0, 1, 0};
  std::copy_n(sheared, 12, stage.pose.begin() + 12 * 2);
  CHECK(nook::test::set_rows(scene, stage.first, stage.pose.data(), stage.info.bone_count) == NOOK_OK);
  nook_scene_desc strict_desc = Host::scene_desc();
  strict_desc.strict_poses = 1;
  nook_scene strict = nullptr;
  nook_instance_id stiff = 0;
  REQUIRE(nook_scene_create(stage.context, &strict_desc, &strict) == NOOK_OK);
  REQUIRE(nook_scene_add_instance(strict, stage.model, &stiff) == NOOK_OK);
  CHECK(nook::test::set_rows(strict, stiff, stage.pose.data(), stage.info.bone_count) == invalid);
  CHECK(last_is("nook_scene_set_pose: ", "check desc.layout"));
  nook_scene_destroy(&strict);
  CHECK(nook_scene_link(scene, stage.first, stage.first) == invalid);
  CHECK(nook_scene_link(scene, stage.first, 99) == no_handle);
  CHECK(nook_scene_link(scene, 99, stage.first) == no_handle);
  CHECK(nook_scene_unlink(scene, stage.first, stage.second) == no_handle);
  CHECK(nook_scene_link_nearest(scene, 17, 1) == invalid);
  CHECK(nook_scene_link_nearest(scene, 4, -1) == invalid);
  CHECK(nook_scene_link_nearest(scene, 4, NAN) == invalid);
  CHECK(nook_scene_set_ground(scene, 99, nullptr) == no_handle);
  CHECK(nook_scene_set_ground(scene, stage.first, plane) == invalid);
  const nook_occluder ball{{0, 0, 0}, 1, 0}, lost{{0, NAN, 0}, 1, 0}, flat{{0, 0, 0}, 0, 0},
      of_nobody{{0, 0, 0}, 1, 99};
  CHECK(nook_scene_add_occluder(scene, nullptr, &occluder) == invalid);
  CHECK(occluder == 0);
  CHECK(nook_scene_add_occluder(scene, &lost, &occluder) == invalid);
  CHECK(nook_scene_add_occluder(scene, &flat, &occluder) == invalid);
  CHECK(nook_scene_add_occluder(scene, &ball, nullptr) == invalid);
  CHECK(nook_scene_add_occluder(scene, &of_nobody, &occluder) == no_handle);
  CHECK(last_is("nook_scene_add_occluder: ", "no instance 99"));
  CHECK(nook_scene_set_occluder(scene, 5, &ball) == no_handle);
  CHECK(nook_scene_set_occluder(scene, 5, nullptr) == invalid);
  REQUIRE(nook_scene_add_occluder(scene, &ball, &occluder) == NOOK_OK);
  CHECK(nook_scene_set_occluder(scene, occluder, &flat) == invalid);
  CHECK(nook_scene_set_occluder(scene, occluder, &of_nobody) == no_handle);
  CHECK(nook_scene_remove_occluder(scene, occluder) == NOOK_OK);
  CHECK(nook_scene_remove_occluder(scene, 5) == no_handle);
  CHECK(nook_scene_set_camera(scene, far) == invalid);
  CHECK(nook_scene_set_camera(scene, nullptr) == NOOK_OK);
  CHECK(nook_scene_set_terms(scene, 16) == invalid);
  CHECK(nook_scene_update(nullptr) == invalid);
  CHECK(nook_scene_read(scene, 99, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, stage.ao.data(),
                        stage.info.file_vertex_count, 0) == no_handle);
  CHECK(nook_scene_read(scene, stage.first, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, nullptr,
                        stage.info.file_vertex_count, 0) == invalid);
  CHECK(nook_scene_read(scene, stage.first, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, stage.ao.data(), 1, 0) ==
        invalid);
  CHECK(nook_scene_read(scene, stage.first, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, stage.ao.data(),
                        stage.info.file_vertex_count, 3) == invalid);

  nook_lobe lobes[NOOK_PROBE_MAX_FUNCTIONS + 1] = {};
  for (nook_lobe& lobe : lobes) lobe.axis[1] = 1;
  std::vector<float> colour(3 * std::size_t(stage.info.file_vertex_count));
  CHECK(nook_scene_set_light(scene, 99, lobes, 1) == no_handle);
  CHECK(nook_scene_set_light(scene, stage.first, lobes, NOOK_PROBE_MAX_FUNCTIONS + 1) == invalid);
  lobes[1].sharpness = -1;
  CHECK(nook_scene_set_light(scene, stage.first, lobes, 2) == invalid);
  CHECK(std::string(nook_last_message()).find("lobe 1") != std::string::npos);
  CHECK(nook_scene_set_light(scene, stage.first, nullptr, 2) == NOOK_OK);
  CHECK(nook_scene_read(scene, 99, NOOK_CHANNEL_DIRECTIONAL_AO, NOOK_FORMAT_FLOAT, colour.data(),
                        stage.info.file_vertex_count, 0) == no_handle);
  CHECK(nook_scene_read(scene, stage.first, NOOK_CHANNEL_DIRECTIONAL_AO, NOOK_FORMAT_FLOAT, nullptr,
                        stage.info.file_vertex_count, 0) == invalid);
  CHECK(nook_scene_read(scene, stage.first, NOOK_CHANNEL_DIRECTIONAL_AO, NOOK_FORMAT_FLOAT, colour.data(), 1,
                        0) == invalid);
  CHECK(nook_scene_read(scene, stage.first, NOOK_CHANNEL_DIRECTIONAL_AO, NOOK_FORMAT_FLOAT, colour.data(),
                        stage.info.file_vertex_count, 8) == invalid);
  CHECK(nook_scene_describe(scene, nullptr) == invalid);
  nook_scene_info info{};
  info.struct_size = sizeof info;
  CHECK(nook_scene_describe(nullptr, &info) == invalid);

  const auto read = [&](nook_channel channel, nook_format format, const char* need) {
    return nook_scene_read(scene, stage.first, channel, format, colour.data(), stage.info.file_vertex_count,
                           0) == invalid &&
           last_is("nook_scene_read: ", need);
  };
  CHECK(read(-1, NOOK_FORMAT_FLOAT, "channel is unknown"));
  CHECK(read(3, NOOK_FORMAT_FLOAT, "channel is unknown"));
  CHECK(read(NOOK_CHANNEL_AO, -1, "format is unknown"));
  CHECK(read(NOOK_CHANNEL_AO, 4, "format is unknown"));
  CHECK(read(NOOK_CHANNEL_AO, NOOK_FORMAT_SNORM8, "NOOK_CHANNEL_AO cannot be read as NOOK_FORMAT_SNORM8"));
  CHECK(read(NOOK_CHANNEL_DIRECTIONAL_AO, NOOK_FORMAT_HALF, "use NOOK_FORMAT_FLOAT"));
  CHECK(read(NOOK_CHANNEL_DIRECTIONAL_AO, NOOK_FORMAT_SNORM8, "cannot be read as NOOK_FORMAT_SNORM8"));
  CHECK(read(NOOK_CHANNEL_BENT_NORMAL, NOOK_FORMAT_FLOAT, "use NOOK_FORMAT_SNORM8"));
  CHECK(nook_scene_update(scene) == NOOK_OK);  // still well
}
