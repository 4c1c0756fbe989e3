// Jobs of clips, and their files in the runtime.
#include <nook/nook_bake.h>
#include <nook/nook_clips.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/bakers/api/baked_tube.h"
#include "tests/catch.h"

namespace {

nook_bake_clips_desc desc_of(const std::string& model) {
  nook_bake_clips_desc desc;
  REQUIRE(nook_bake_clips_desc_init(&desc) == NOOK_OK);
  desc.model = model.data();
  desc.model_size = model.size();
  desc.rays = 32;
  desc.frames_per_second = 10;
  return desc;
}

nook_result start_result(const Character& character, const nook_bake_clips_desc& desc) {
  return start_result_of(character, desc);
}

}  // namespace

TEST_CASE("a job of clips gives a file for the model, the same on any number of threads") {
  const std::string model_bytes = model_of(tube_with_clips());
  nook_bake_clips_desc desc = desc_of(model_bytes);
  std::string first;
  for (const std::uint32_t threads : {1u, 3u}) {
    desc.threads = threads;
    nook_bake_job started = nullptr;
    Character character = tube_with_clips();
    desc.character = character.get();
    REQUIRE(nook_bake_start_clips(&desc, &started) == NOOK_OK);
    character.reset();  // the job keeps it
    const Job job(started);
    const std::string bytes = bytes_of(job.get());
    const char* report = nullptr;
    REQUIRE(nook_bake_job_report(job.get(), &report) == NOOK_OK);
    CHECK(nlohmann::json::parse(report)["clips"] == 2);
    if (first.empty()) first = bytes;
    CHECK(bytes == first);
  }
  nook_context_desc context_desc;
  nook_context context = nullptr;
  nook_model model = nullptr;
  nook_clips clips = nullptr;
  REQUIRE(nook_context_desc_init(&context_desc) == NOOK_OK);
  REQUIRE(nook_context_create(&context_desc, &context) == NOOK_OK);
  REQUIRE(nook_model_load(context, model_bytes.data(), model_bytes.size(), &model) == NOOK_OK);
  REQUIRE(nook_clips_load(context, model, first.data(), first.size(), &clips) == NOOK_OK);
  nook_clips_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_clips_describe(clips, &info) == NOOK_OK);
  CHECK(info.clip_count == 2);    // the T-pose shows no motion
  CHECK(info.frame_count == 22);  // one second each, at 10 frames and both ends
  nook_clips_destroy(&clips);
  nook_model_destroy(&model);
  nook_context_destroy(&context);
}

TEST_CASE("faults of a job of clips come before it starts, with their cause") {
  const Character character = tube_with_clips();
  const std::string model = model_of(character), plain = model_of(tube_character());
  // Blocks instead of sections, because each section would bake the model again.
  const nook_bake_clips_desc sound = desc_of(model);
  {
    INFO("an unknown clip");
    nook_bake_clips_desc desc = sound;
    const char* const names[] = {"wave", "fly"};
    desc.clip_names = names;
    desc.clip_count = 2;
    CHECK(start_result(character, desc) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("fly"));
    CHECK(message_has("bend"));
  }
  {
    INFO("a NULL among the names");
    nook_bake_clips_desc desc = sound;
    const char* const names[] = {nullptr};
    desc.clip_names = names;
    desc.clip_count = 1;
    CHECK(start_result(character, desc) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("desc.clip_names[i]"));
  }
  {
    INFO("modes that are no multiple of 4");
    nook_bake_clips_desc desc = sound;
    desc.max_modes = 6;
    CHECK(start_result(character, desc) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("desc.max_modes is not a multiple of 4 (got 6)"));
  }
  {
    INFO("numbers out of range");
    nook_bake_clips_desc desc = sound;
    for (float nook_bake_clips_desc::*field :
         {&nook_bake_clips_desc::frames_per_second, &nook_bake_clips_desc::max_error,
          &nook_bake_clips_desc::max_bytes})
      for (const float bad : {0.0f, -1.0f, 1e9f, std::numeric_limits<float>::quiet_NaN()}) {
        nook_bake_clips_desc wrong = desc;
        wrong.*field = bad;
        CHECK(start_result(character, wrong) == NOOK_ERROR_INVALID_ARGUMENT);
        CHECK(message_has("is out of range"));
      }
    desc.rays = 0;
    CHECK(start_result(character, desc) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("desc.rays is out of range (got 0, need 1 to 65536)"));
  }
  {
    INFO("no model");
    nook_bake_clips_desc desc = sound;
    desc.model = nullptr;
    CHECK(start_result(character, desc) == NOOK_ERROR_INVALID_ARGUMENT);
    const char bytes[40] = {};
    desc.model = bytes;
    desc.model_size = sizeof bytes;
    CHECK(start_result(character, desc) == NOOK_ERROR_BAD_FILE);
  }
  {
    INFO("the model of another character");
    nook_bake_clips_desc desc = sound;
    desc.model = plain.data();
    desc.model_size = plain.size();
    CHECK(start_result(character, desc) == NOOK_ERROR_BAD_FILE);
    CHECK(message_has("was not baked from this character"));
  }
  {
    INFO("a character without clips");
    nook_bake_clips_desc desc = sound;
    desc.model = plain.data();
    desc.model_size = plain.size();
    CHECK(start_result(tube_character(), desc) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("no clip that shows motion"));
  }
}
