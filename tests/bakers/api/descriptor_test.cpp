// The structs of the bakers' headers as callers of older and newer headers pass them.
#include <nook/experimental/nook_bake_materials.h>
#include <nook/experimental/nook_trace.h>
#include <nook/nook_bake.h>

#include "tests/abi/growing_struct.h"
#include "tests/bakers/api/handles.h"

using namespace nook::test;

TEST_CASE("init functions fill what fits into the caller's struct, of every release") {
  check_init<nook_bake_source_desc>(nook_bake_desc_init, NOOK_DESC_BAKE_SOURCE);
  check_init<nook_bake_character_desc>(nook_bake_desc_init, NOOK_DESC_BAKE_CHARACTER);
  check_init<nook_bake_trace_desc>(nook_bake_desc_init, NOOK_DESC_BAKE_TRACE);
  check_init<nook_bake_irradiance_desc>(nook_bake_desc_init, NOOK_DESC_BAKE_IRRADIANCE);
  check_init<nook_bake_character_study_desc>(nook_bake_desc_init, NOOK_DESC_BAKE_CHARACTER_STUDY, 32);
  check_init<nook_bake_material_desc>(nook_bake_desc_init, NOOK_DESC_BAKE_MATERIAL);

  nook_bake_source_desc desc;
  CHECK(nook_bake_source_desc_init(nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("nook_bake_source_desc_init: desc is NULL"));
  CHECK(nook_bake_desc_init(NOOK_DESC_BAKE_SOURCE, &desc, 8, NOOK_VERSION) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("size is out of range (got 8, need at least 160)"));
}

TEST_CASE("descriptors of every release are read, and what a newer one adds is refused unless 0") {
  tube t;
  make_tube(&t);
  check_use(describe_tube(&t), [](const nook_bake_source_desc* desc) {
    nook_bake_character character = nullptr;
    const nook_result result = nook_bake_character_create(desc, &character);
    nook_bake_character_destroy(&character);
    return result;
  });

  const Character character = tube_character();
  nook_bake_character_desc job_desc;
  REQUIRE(nook_bake_character_desc_init(&job_desc) == NOOK_OK);
  job_desc.character = character.get();
  job_desc.preset = NOOK_BAKE_PRESET_DRAFT;
  job_desc.auto_pose_count = 8;  // poses are made before a job can be cancelled
  check_use(job_desc, [&](const nook_bake_character_desc* desc) {
    nook_bake_job job = nullptr;
    const nook_result result = nook_bake_start_character(desc, &job);
    nook_bake_job_destroy(&job);  // cancels: only what start says matters here
    return result;
  });

  const float at[3] = {0, 0, 0}, up[3] = {0, 1, 0};
  nook_bake_trace_desc trace_desc;
  REQUIRE(nook_bake_trace_desc_init(&trace_desc) == NOOK_OK);
  trace_desc.positions = at;
  trace_desc.normals = up;
  trace_desc.point_count = 1;
  check_use(trace_desc, [](const nook_bake_trace_desc* desc) {
    float ao = 0;
    return nook_bake_trace_ao(desc, &ao, 1);
  });
  nook_bake_irradiance_desc light_desc;
  REQUIRE(nook_bake_irradiance_desc_init(&light_desc) == NOOK_OK);
  light_desc.positions = at;
  light_desc.normals = up;
  light_desc.point_count = 1;
  check_use(light_desc, [](const nook_bake_irradiance_desc* desc) {
    float irradiance[3];
    return nook_bake_trace_irradiance(desc, irradiance, 1);
  });

  nook_bake_material_desc material_desc;
  REQUIRE(nook_bake_material_desc_init(&material_desc) == NOOK_OK);
  material_desc.meso = "weave";
  material_desc.bounce_rays = 2;  // reflections are traced before a job can be cancelled
  check_use(material_desc, [](const nook_bake_material_desc* desc) {
    nook_bake_job job = nullptr;
    const nook_result result = nook_bake_start_material(desc, &job);
    nook_bake_job_destroy(&job);
    return result;
  });

  const std::uint32_t triangle[3] = {0, 0, 0};
  nook_bake_transfer_desc transfer_desc;
  REQUIRE(nook_bake_transfer_desc_init(&transfer_desc) == NOOK_OK);
  transfer_desc.positions = at;
  transfer_desc.normals = up;
  transfer_desc.uvs = at;
  transfer_desc.indices = triangle;
  transfer_desc.vertex_count = 1;
  transfer_desc.index_count = 3;
  check_use(transfer_desc, [](const nook_bake_transfer_desc* desc) {
    nook_bake_job job = nullptr;
    const nook_result result = nook_bake_start_transfer(desc, &job);
    nook_bake_job_destroy(&job);
    return result;
  });
}

TEST_CASE("answers are cut to the caller's struct") {
  const Character character = tube_character();
  check_info<nook_bake_character_info>(
      [&](nook_bake_character_info* info) { return nook_bake_character_describe(character.get(), info); });

  nook_bake_character_desc desc;
  REQUIRE(nook_bake_character_desc_init(&desc) == NOOK_OK);
  desc.character = character.get();
  nook_bake_job handle = nullptr;
  REQUIRE(nook_bake_start_character(&desc, &handle) == NOOK_OK);
  const Job job(handle);
  check_info<nook_bake_progress>(
      [&](nook_bake_progress* progress) { return nook_bake_job_poll(job.get(), progress); });
}
