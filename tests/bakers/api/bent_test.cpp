// Jobs of bent normals, and their models in the runtime.
#include <nook/nook_bake.h>
#include <nook/nook_character.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/bakers/api/baked_tube.h"

namespace {

nook_bake_bent_desc desc_of(const std::string& model) {
  nook_bake_bent_desc desc;
  REQUIRE(nook_bake_bent_desc_init(&desc) == NOOK_OK);
  desc.model = model.data();
  desc.model_size = model.size();
  desc.auto_pose_count = 8;
  desc.rays = 16;
  return desc;
}

nook_result start_result(const Character& character, const nook_bake_bent_desc& desc) {
  return start_result_of(character, desc);
}

}  // namespace

TEST_CASE("a job of bent normals adds them to the model, the same on any number of threads") {
  const std::string plain = model_of(tube_with_clips());
  nook_bake_bent_desc desc = desc_of(plain);
  std::string first;
  for (const std::uint32_t threads : {1u, 3u}) {
    desc.threads = threads;
    nook_bake_job started = nullptr;
    Character character = tube_with_clips();
    desc.character = character.get();
    REQUIRE(nook_bake_start_bent(&desc, &started) == NOOK_OK);
    character.reset();  // the job keeps it
    const Job job(started);
    const std::string bytes = bytes_of(job.get());
    const char* text = nullptr;
    REQUIRE(nook_bake_job_report(job.get(), &text) == NOOK_OK);
    const auto report = nlohmann::json::parse(text);
    CHECK(report["model_bytes"] == bytes.size());
    CHECK(report["bent_bytes"] == 6 * report["vertices"].get<int>());
    if (first.empty()) first = bytes;
    CHECK(bytes == first);
  }
  nook_context_desc context_desc;
  nook_context context = nullptr;
  REQUIRE(nook_context_desc_init(&context_desc) == NOOK_OK);
  REQUIRE(nook_context_create(&context_desc, &context) == NOOK_OK);
  for (const std::string* bytes : {&plain, static_cast<const std::string*>(&first)}) {
    nook_model model = nullptr;
    nook_model_info info{};
    info.struct_size = sizeof info;
    REQUIRE(nook_model_load(context, bytes->data(), bytes->size(), &model) == NOOK_OK);
    REQUIRE(nook_model_describe(model, &info) == NOOK_OK);
    std::vector<std::int8_t> occluded(8 * info.file_vertex_count);
    CHECK(nook_model_read(model, NOOK_MODEL_OCCLUDED_DIRECTIONS, occluded.data(), info.file_vertex_count,
                          0) == (bytes == &plain ? NOOK_ERROR_UNSUPPORTED : NOOK_OK));
    nook_model_destroy(&model);
  }
  nook_context_destroy(&context);
}

TEST_CASE("a job of bent normals is cancelled by its progress function") {
  const std::string model = model_of(tube_with_clips());
  nook_bake_bent_desc desc = desc_of(model);
  desc.progress = [](void*, const nook_bake_progress*) -> std::int32_t { return 0; };
  nook_bake_job started = nullptr;
  Character character = tube_with_clips();
  desc.character = character.get();
  REQUIRE(nook_bake_start_bent(&desc, &started) == NOOK_OK);
  character.reset();  // the job keeps it
  const Job job(started);
  CHECK(nook_bake_job_wait(job.get()) == NOOK_ERROR_CANCELLED);
}

TEST_CASE("faults of a job of bent normals come before it starts, with their cause") {
  const Character character = tube_with_clips();
  const std::string model = model_of(character);
  // Blocks instead of sections, because each section would bake the model again.
  const nook_bake_bent_desc sound = desc_of(model);
  {
    INFO("numbers out of range");
    nook_bake_bent_desc desc = sound;
    desc.rays = 0;
    CHECK(start_result(character, desc) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("desc.rays is out of range (got 0, need 1 to 65536)"));
    desc = sound;
    desc.auto_pose_count = 7;
    CHECK(start_result(character, desc) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("desc.auto_pose_count is out of range (got 7, need 8 to 100000)"));
    desc = sound;
    desc.samples_per_clip = 100'001;
    CHECK(start_result(character, desc) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("desc.samples_per_clip"));
    desc = sound;
    desc.threads = 1025;
    CHECK(start_result(character, desc) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("desc.threads is out of range (got 1025, need at most 1024)"));
  }
  {
    INFO("no model");
    nook_bake_bent_desc desc = sound;
    desc.model = nullptr;
    CHECK(start_result(character, desc) == NOOK_ERROR_INVALID_ARGUMENT);
    const char bytes[40] = {};
    desc.model = bytes;
    desc.model_size = sizeof bytes;
    CHECK(start_result(character, desc) == NOOK_ERROR_BAD_FILE);
  }
  {
    INFO("the model of another character");
    nook_bake_bent_desc desc = sound;
    const std::string other = model_of(tube_character());
    desc.model = other.data();
    desc.model_size = other.size();
    CHECK(start_result(character, desc) == NOOK_ERROR_BAD_FILE);
    CHECK(message_has("was not baked from this character"));
  }
}
