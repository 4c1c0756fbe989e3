// Every error code with its text, and every parameter out of its range.
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
  CHECK(last_is("nook_context_create: ", "only one function"));
}

TEST_CASE("models: bad parameters and bad files") {
  Stage stage;
  const auto& bytes = stage.host.bytes;
  nook_character_model model = stage.model;
  CHECK(nook_character_model_load(nullptr, bytes.data(), bytes.size(), &model) == invalid);
  CHECK(model == nullptr);
  CHECK(nook_character_model_load(stage.context, nullptr, 4, &model) == invalid);
  CHECK(nook_character_model_load(stage.context, bytes.data(), bytes.size(), nullptr) == invalid);
  CHECK(nook_character_model_load(stage.context, bytes.data(), bytes.size() - 1, &model) ==
        NOOK_ERROR_BAD_FILE);
  CHECK(last_is("nook_character_model_load: ", "size is wrong"));
  auto newer = bytes;
  newer[8] = std::byte{9};
  CHECK(nook_character_model_load(stage.context, newer.data(), newer.size(), &model) ==
        NOOK_ERROR_FILE_VERSION);
  CHECK(last_is("nook_character_model_load: ", "got 9, need 4"));

  std::uint32_t first = 0, count = 0;
  CHECK(nook_character_model_primitive(stage.model, 2, &first, &count) == invalid);
  CHECK(last_is("nook_character_model_primitive: ", "got 2, need less than 2"));
  CHECK(nook_character_model_primitive(nullptr, 0, &first, &count) == invalid);
  CHECK(nook_character_model_primitive(stage.model, 0, nullptr, &count) == invalid);
  CHECK(nook_character_model_primitive(stage.model, 0, &first, nullptr) == invalid);
  CHECK(nook_character_model_bone_name(nullptr, 0) == nullptr);
  CHECK(nook_character_model_describe(nullptr, &stage.info) == invalid);
  CHECK(nook_character_model_describe(stage.model, nullptr) == invalid);
  CHECK(nook_character_model_static_ao(stage.model, stage.ao.data(), 3) == invalid);
  CHECK(nook_character_model_static_ao(nullptr, stage.ao.data(), 3) == invalid);
  CHECK(nook_character_model_static_ao(stage.model, nullptr, stage.info.file_vertex_count) == invalid);

  nook::CharacterModel bare = sample_model();
  bare.static_ao.clear();
  const auto bare_bytes = nook::write_character_model(bare);
  REQUIRE(nook_character_model_load(stage.context, bare_bytes.data(), bare_bytes.size(), &model) == NOOK_OK);
  CHECK(nook_character_model_static_ao(model, stage.ao.data(), stage.info.file_vertex_count) ==
        NOOK_ERROR_UNSUPPORTED);
  nook_character_model_destroy(&model);
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
  CHECK(refused([](auto& d) { d.combine = 2; }, "desc.combine"));
  CHECK(refused([](auto& d) { d.combine = -1; }, "desc.combine"));
  CHECK(refused([](auto& d) { d.isa = INT32_MAX; }, "desc.isa"));
  CHECK(refused([](auto& d) { d.cutoff_error = NAN; }, "desc.cutoff_error"));
  CHECK(refused([](auto& d) { d.cutoff_error = 1.1f; }, "desc.cutoff_error"));
  CHECK(refused([](auto& d) { d.far_error = NAN; }, "desc.far_error"));
  CHECK(refused([](auto& d) { d.far_error = -1; }, "desc.far_error"));
  CHECK(refused([](auto& d) { d.reserved = 1; }, "desc.reserved"));
  CHECK(refused([](auto& d) { d.lod_error = -1; }, "desc.lod_error"));
  CHECK(refused([](auto& d) { d.lod_distance = 0; }, "desc.lod_distance"));
  CHECK(refused([](auto& d) { d.lod_max_interval = 0; }, "desc.lod_max_interval"));
  CHECK(refused([](auto& d) { d.ground_radius = INFINITY; }, "desc.ground_radius"));
  const nook_scene_desc good = Host::scene_desc();
  nook_scene scene = nullptr;
  CHECK(nook_scene_create(nullptr, &good, &scene) == invalid);
  CHECK(nook_scene_create(stage.context, &good, nullptr) == invalid);

  // No machine has all instruction sets. What is missing is named, with those that are there.
  for (nook_isa isa = NOOK_ISA_SCALAR;; ++isa) {
    nook_scene_desc chosen = good;
    chosen.isa = isa;
    const nook_result result = nook_scene_create(stage.context, &chosen, &scene);
    nook_scene_destroy(&scene);
    if (result == NOOK_OK) continue;
    if (result == NOOK_ERROR_UNSUPPORTED) {
      CHECK(last_is("nook_scene_create: ", "need one of scalar"));
      continue;
    }
    CHECK((result == invalid && isa > NOOK_ISA_AVX512 &&
           last_is("nook_scene_create: ", "desc.isa is unknown")));
    break;
  }
  nook_scene_destroy(&scene);
}

TEST_CASE("scenes: bad handles and parameters of every call") {
  Stage stage;
  nook_scene scene = stage.scene;
  const float centre[3] = {0, 0, 0}, far[3] = {0, NAN, 0};
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
  CHECK(nook_scene_set_pose(scene, 99, stage.pose.data(), stage.info.bone_count) == no_handle);
  CHECK(nook_scene_set_pose(scene, stage.first, nullptr, stage.info.bone_count) == invalid);
  CHECK(nook_scene_set_pose(scene, stage.first, stage.pose.data(), stage.info.bone_count - 1) == invalid);
  CHECK(last_is("nook_scene_set_pose: ", "got 4, need 5"));
  stage.pose[12 * 2 + 5] = NAN;
  CHECK(nook_scene_set_pose(scene, stage.first, stage.pose.data(), stage.info.bone_count) == invalid);
  CHECK(last_is("nook_scene_set_pose: ", "bone 2"));
  // The axes x and y have unit length and the cosine 0.1 between them.
  const float sheared[12] = {1, 0.1f, 0, 0, 0, 0.99498744f, 0, 0, 0, 0, 1, 0};
  std::copy_n(sheared, 12, stage.pose.begin() + 12 * 2);
  CHECK(nook_scene_set_pose(scene, stage.first, stage.pose.data(), stage.info.bone_count) == NOOK_OK);
  nook_scene_desc strict_desc = Host::scene_desc();
  strict_desc.strict_poses = 1;
  nook_scene strict = nullptr;
  nook_instance_id stiff = 0;
  REQUIRE(nook_scene_create(stage.context, &strict_desc, &strict) == NOOK_OK);
  REQUIRE(nook_scene_add_instance(strict, stage.model, &stiff) == NOOK_OK);
  CHECK(nook_scene_set_pose(strict, stiff, stage.pose.data(), stage.info.bone_count) == invalid);
  CHECK(last_is("nook_scene_set_pose: ", "bones_3x4 is row-major"));
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
  CHECK(nook_scene_add_occluder(scene, nullptr, 1, &occluder) == invalid);
  CHECK(occluder == 0);
  CHECK(nook_scene_add_occluder(scene, far, 1, &occluder) == invalid);
  CHECK(nook_scene_add_occluder(scene, centre, 0, &occluder) == invalid);
  CHECK(nook_scene_add_occluder(scene, centre, 1, nullptr) == invalid);
  CHECK(nook_scene_set_occluder(scene, 5, centre, 1) == no_handle);
  CHECK(nook_scene_remove_occluder(scene, 5) == no_handle);
  CHECK(nook_scene_set_camera(scene, far) == invalid);
  CHECK(nook_scene_set_camera(scene, nullptr) == NOOK_OK);
  CHECK(nook_scene_set_terms(scene, 16) == invalid);
  CHECK(nook_scene_update(nullptr) == invalid);
  CHECK(nook_scene_read_ao(scene, 99, stage.ao.data(), stage.info.file_vertex_count, 0) == no_handle);
  CHECK(nook_scene_read_ao(scene, stage.first, nullptr, stage.info.file_vertex_count, 0) == invalid);
  CHECK(nook_scene_read_ao(scene, stage.first, stage.ao.data(), 1, 0) == invalid);
  CHECK(nook_scene_read_ao(scene, stage.first, stage.ao.data(), stage.info.file_vertex_count, 3) == invalid);

  nook_probe_lobe lobes[NOOK_PROBE_MAX_FUNCTIONS + 1] = {};
  for (nook_probe_lobe& lobe : lobes) lobe.axis[1] = 1;
  std::vector<float> colour(3 * std::size_t(stage.info.file_vertex_count));
  CHECK(nook_scene_set_light(scene, 99, lobes, 1) == no_handle);
  CHECK(nook_scene_set_light(scene, stage.first, lobes, NOOK_PROBE_MAX_FUNCTIONS + 1) == invalid);
  lobes[1].sharpness = -1;
  CHECK(nook_scene_set_light(scene, stage.first, lobes, 2) == invalid);
  CHECK(std::string(nook_last_message()).find("lobe 1") != std::string::npos);
  CHECK(nook_scene_set_light(scene, stage.first, nullptr, 2) == NOOK_OK);
  CHECK(nook_scene_read_directional_ao(scene, 99, colour.data(), stage.info.file_vertex_count, 0) ==
        no_handle);
  CHECK(nook_scene_read_directional_ao(scene, stage.first, nullptr, stage.info.file_vertex_count, 0) ==
        invalid);
  CHECK(nook_scene_read_directional_ao(scene, stage.first, colour.data(), 1, 0) == invalid);
  CHECK(nook_scene_read_directional_ao(scene, stage.first, colour.data(), stage.info.file_vertex_count, 8) ==
        invalid);
  CHECK(nook_scene_read_stats(scene, nullptr) == invalid);
  std::uint64_t bytes = 0;
  CHECK(nook_scene_memory(scene, nullptr) == invalid);
  CHECK(nook_scene_memory(nullptr, &bytes) == invalid);
  CHECK(nook_scene_update(scene) == NOOK_OK);  // still well
}
