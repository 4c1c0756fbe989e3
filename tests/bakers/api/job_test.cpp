#include <nook/experimental/nook_trace.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/bakers/api/handles.h"
#include "tests/catch.h"

namespace {

// Small enough for a second, and every stage is run through. Most of its time goes to its casters, by the
// number of poses.
nook_bake_character_desc small_bake() {
  nook_bake_character_desc desc;
  nook_bake_character_desc_init(&desc);
  desc.preset = NOOK_BAKE_PRESET_DRAFT;
  desc.pose_mode = NOOK_BAKE_POSES_AUTO;
  desc.auto_pose_count = 8;
  desc.spheres = 8;
  desc.key_points = 24;
  desc.rays = 4;
  desc.steps = 40;
  return desc;
}

Job start(const Character& character, nook_bake_character_desc desc) {
  desc.character = character.get();
  nook_bake_job job = nullptr;
  const nook_result result = nook_bake_start_character(&desc, &job);
  INFO(nook_bake_last_message());
  CHECK(result == NOOK_OK);
  return Job(job);
}

std::vector<char> model_of(const Job& job) {
  const nook_result result = nook_bake_job_wait(job.get());
  INFO(nook_bake_last_message());
  REQUIRE(result == NOOK_OK);
  const void* bytes = nullptr;
  std::size_t size = 0;
  REQUIRE(nook_bake_job_file(job.get(), &bytes, &size) == NOOK_OK);
  const char* first = static_cast<const char*>(bytes);
  return {first, first + size};
}

nook_result start_result(const Character& character, nook_bake_character_desc desc) {
  desc.character = character.get();
  nook_bake_job job = nullptr;
  const nook_result result = nook_bake_start_character(&desc, &job);
  CHECK((job != nullptr) == (result == NOOK_OK));
  nook_bake_job_destroy(&job);
  return result;
}

// Cancels at the n-th call, and notes whether a call came after the job was over.
struct Canceller {
  int left;
  std::atomic<bool> over{false}, late{false};
  static std::int32_t call(void* user, const nook_bake_progress*) {
    Canceller& c = *static_cast<Canceller*>(user);
    if (c.over) c.late = true;
    return --c.left > 0;
  }
};

}  // namespace

TEST_CASE("the same seed gives the same bytes on any number of threads") {
  const Character character = tube_character();
  nook_bake_character_desc desc = small_bake();
  desc.threads = 1;
  const std::vector<char> one = model_of(start(character, desc));
  desc.threads = 2;
  const std::vector<char> two = model_of(start(character, desc));
  CHECK(one == two);
  desc.seed = 2;
  CHECK(model_of(start(character, desc)) != one);
}

TEST_CASE("two bakes at the same time give the same results as each one alone") {
  const Character character = tube_character();
  nook_bake_character_desc desc = small_bake();
  const std::vector<char> alone = model_of(start(character, desc));
  nook_bake_character_desc other = desc;
  other.seed = 9;
  const Job a = start(character, desc), b = start(character, other), c = start(character, desc);
  CHECK(model_of(a) == alone);
  CHECK(model_of(c) == alone);
  CHECK(model_of(b) != alone);
}

TEST_CASE("a job can be cancelled at any point of its progress") {
  const Character character = tube_character();
  nook_bake_character_desc desc = small_bake();
  desc.auto_pose_count = 40;
  for (int calls : {1, 2, 5, 17, 39, 40, 41, 43}) {
    Canceller canceller{calls};
    desc.progress = Canceller::call;
    desc.progress_user = &canceller;
    const Job job = start(character, desc);
    const nook_result result = nook_bake_job_wait(job.get());
    canceller.over = true;
    INFO("cancelled at call " << calls << ": " << nook_bake_last_message());
    // A bake may have fewer calls than that; a cancelled one stopped.
    CHECK(result == (canceller.left <= 0 ? NOOK_ERROR_CANCELLED : NOOK_OK));
    if (calls <= 40) CHECK(result == NOOK_ERROR_CANCELLED);  // one call a traced pose at least
    const void* bytes = nullptr;
    std::size_t size = 0;
    CHECK(nook_bake_job_file(job.get(), &bytes, &size) == result);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    CHECK_FALSE(canceller.late);
  }
}

TEST_CASE("destroying a running job cancels it and waits") {
  Character character = tube_character();
  nook_bake_character_desc desc = small_bake();
  desc.auto_pose_count = 20000;
  Canceller canceller{1 << 30};
  desc.progress = Canceller::call;
  desc.progress_user = &canceller;
  Job job = start(character, desc);
  // The job keeps what it needs.
  character.reset();
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  nook_bake_progress progress{};
  progress.struct_size = sizeof progress;
  CHECK(nook_bake_job_poll(job.get(), &progress) == NOOK_OK);
  CHECK(progress.state != NOOK_BAKE_DONE);
  REQUIRE(progress.stage != nullptr);
  CHECK(std::string(progress.stage) != "done");
  const void* bytes = nullptr;
  std::size_t size = 0;
  CHECK(nook_bake_job_file(job.get(), &bytes, &size) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("still running"));
  job.reset();
  canceller.over = true;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  CHECK_FALSE(canceller.late);
}

TEST_CASE("cancel from another thread ends a job soon") {
  const Character character = tube_character();
  nook_bake_character_desc desc = small_bake();
  desc.auto_pose_count = 2000;
  desc.rays = 4096;
  const Job job = start(character, desc);
  std::thread([&] { nook_bake_job_cancel(job.get()); }).join();
  CHECK(nook_bake_job_wait(job.get()) == NOOK_ERROR_CANCELLED);
  CHECK(nook_bake_job_wait(job.get()) == NOOK_ERROR_CANCELLED);
  CHECK(message_has("nook_bake_job_wait: "));
  nook_bake_progress progress{};
  progress.struct_size = sizeof progress;
  CHECK(nook_bake_job_poll(job.get(), &progress) == NOOK_OK);
  CHECK(progress.state == NOOK_BAKE_DONE);
  CHECK(std::string(progress.stage) == "done");
}

TEST_CASE("the report describes the bake") {
  const Character character = tube_character();
  nook_bake_character_desc desc = small_bake();
  std::vector<float> extra(24 * 3);
  REQUIRE(nook_bake_character_auto_poses(character.get(), 77, 3, extra.data(), 2) == NOOK_OK);
  desc.extra_poses_3x4 = extra.data();
  desc.extra_pose_count = 3;
  desc.gamma = 2;
  nook_bake_character_study_desc study;
  REQUIRE(nook_bake_character_study_desc_init(&study) == NOOK_OK);
  study.kernel = NOOK_FORM_PAPER;
  desc.next = &study;
  const Job job = start(character, desc);
  model_of(job);
  const char* text = nullptr;
  REQUIRE(nook_bake_job_report(job.get(), &text) == NOOK_OK);
  const nlohmann::json report = nlohmann::json::parse(text);
  CHECK(report.at("train_poses").get<int>() <= 11);
  CHECK(report.at("train_poses").get<int>() > 5);
  CHECK(report.at("vertices") == tube_vertices);
  CHECK(report.at("gamma").get<float>() == 2);
  CHECK(report.at("recipe").at("kernel") == "paper");
  CHECK(report.at("recipe").at("fit") == "nook");
  CHECK(report.at("recipe").at("extra_poses") == 3);
  CHECK(report.at("recipe").at("auto_poses") == 8);
  CHECK(report.at("recipe").at("poses") == "auto");
  for (const char* key :
       {"seconds_raytrace", "seconds_fit", "iterations", "mse_initial", "mse_train", "curve", "peak_bytes"})
    CHECK(report.contains(key));
}

TEST_CASE("the paper's form has its kernel, its fit and its exponent") {
  const Character character = tube_character();
  nook_bake_character_desc desc = small_bake();
  desc.form = NOOK_FORM_PAPER;
  desc.steps = 2;
  const Job job = start(character, desc);
  model_of(job);
  const char* text = nullptr;
  REQUIRE(nook_bake_job_report(job.get(), &text) == NOOK_OK);
  const nlohmann::json report = nlohmann::json::parse(text);
  CHECK(report.at("recipe").at("kernel") == "paper");
  CHECK(report.at("recipe").at("fit") == "paper");
  CHECK(report.at("gamma").get<float>() == 2);
}

TEST_CASE("a bake of the host's own poses alone") {
  const Character character = tube_character();
  nook_bake_character_desc desc = small_bake();
  desc.pose_mode = NOOK_BAKE_POSES_EXTRA;
  std::vector<float> poses(24 * 10);
  REQUIRE(nook_bake_character_auto_poses(character.get(), 5, 10, poses.data(), 2) == NOOK_OK);
  desc.extra_poses_3x4 = poses.data();
  desc.extra_pose_count = 10;
  CHECK_FALSE(model_of(start(character, desc)).empty());
  poses[13] = std::numeric_limits<float>::infinity();
  CHECK(start_result(character, desc) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("the matrix of bone 1 in pose 0 is not finite or far too large"));
  // A finite pose that Embree would end the process for.
  poses[13] = 0;
  poses[24 * 7 + 3] = 1e20f;
  CHECK(start_result(character, desc) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("the matrix of bone 0 in pose 7 is not finite or far too large"));
}

TEST_CASE("settings that make no sense are refused before the job starts") {
  const Character character = tube_character();
  nook_bake_character_desc desc = small_bake();
  nook_bake_character_study_desc study;
  REQUIRE(nook_bake_character_study_desc_init(&study) == NOOK_OK);
  desc.next = &study;
  const char* clips[] = {"walk"};
  const char* expected = "";
  SECTION("preset") {
    desc.preset = 7;
    expected = "desc.preset has an unknown value (got 7)";
  }
  SECTION("poses") {
    desc.pose_mode = -1;
    expected = "desc.pose_mode has an unknown value (got -1)";
  }
  SECTION("form") {
    desc.form = 2;
    expected = "desc.form has an unknown value (got 2)";
  }
  SECTION("kernel of a study") {
    study.kernel = 3;
    expected = "desc.next: kernel has an unknown value";
  }
  SECTION("fit of a study") {
    study.fit = 3;
    expected = "desc.next: fit has an unknown value";
  }
  SECTION("an extension of another type") {
    study.type = NOOK_DESC_BAKE_CLIPS;
    expected = "desc.next points to a descriptor that cannot extend this one";
  }
  SECTION("saturation of the paper's form") {
    desc.saturation = 1;
    desc.form = NOOK_FORM_PAPER;
    expected =
        "desc.saturation needs the default form and a gamma of 1 (got saturation 1, fit paper, gamma 0)";
  }
  SECTION("gamma") {
    desc.gamma = 0.5f;
    expected = "desc.gamma is out of range (got 0.5";
  }
  SECTION("saturation below what stands for none") {
    desc.saturation = -0.5f;
    expected = "desc.saturation is out of range (got -0.5, need 0 to 64";
  }
  SECTION("saturation above the bound") {
    desc.saturation = 65;
    expected = "desc.saturation is out of range (got 65";
  }
  SECTION("saturation that is not a number") {
    desc.saturation = std::nanf("");
    expected = "desc.saturation is out of range";
  }
  SECTION("saturation of a fit that has none") {
    desc.saturation = 1;
    desc.gamma = 2;
    expected =
        "desc.saturation needs the default form and a gamma of 1 (got saturation 1, fit nook, gamma 2)";
  }
  SECTION("gamma below what stands for learned") {
    desc.gamma = -2;
    expected = "desc.gamma is out of range (got -2";
  }
  SECTION("gamma that is not a number") {
    desc.gamma = std::nanf("");
    expected = "desc.gamma is out of range";
  }
  SECTION("time limit") {
    desc.time_limit_s = -1;
    expected = "desc.time_limit_s is out of range";
  }
  SECTION("spheres") {
    desc.spheres = 1u << 30;
    expected = "desc.spheres is out of range";
  }
  SECTION("clips of a character that has none") {
    desc.pose_mode = NOOK_BAKE_POSES_CLIPS;
    expected = "no clip that shows motion";
  }
  SECTION("an unknown clip") {
    desc.pose_mode = NOOK_BAKE_POSES_CLIPS;
    desc.clip_names = clips;
    desc.clip_count = 1;
    expected = "walk";
  }
  SECTION("clips that are not used") {
    desc.clip_names = clips;
    desc.clip_count = 1;
    expected = "desc.pose_mode uses no clips";
  }
  SECTION("clip names missing") {
    desc.pose_mode = NOOK_BAKE_POSES_ALL;
    desc.clip_count = 1;
    expected = "desc.clip_names is NULL";
  }
  SECTION("split") {
    desc.pose_mode = NOOK_BAKE_POSES_ALL;
    study.clip_split = 5;
    expected = "desc.next: clip_split has an unknown value";
  }
  SECTION("extra poses missing") {
    desc.extra_pose_count = 1;
    expected = "desc.extra_poses_3x4 is NULL";
  }
  SECTION("no poses at all") {
    desc.pose_mode = NOOK_BAKE_POSES_EXTRA;
    expected = "desc.extra_pose_count is 0";
  }
  SECTION("descriptor of another type") {
    desc.type = NOOK_DESC_BAKE_TRACE;
    expected = "desc is a nook_bake_trace_desc, which does not start a bake";
  }
  CHECK(start_result(character, desc) == NOOK_ERROR_INVALID_ARGUMENT);
  INFO(nook_bake_last_message());
  CHECK(message_has(expected));
  CHECK(message_has("nook_bake_start: "));
}

TEST_CASE("NULL jobs are refused, or ignored by destroy") {
  const Character character = tube_character();
  nook_bake_character_desc desc = small_bake();
  nook_bake_job job = nullptr;
  CHECK(nook_bake_start(&desc, &job) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("desc.character is NULL"));
  desc.character = character.get();
  CHECK(nook_bake_start(nullptr, &job) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_bake_start(&desc, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  desc.type = 999;
  CHECK(nook_bake_start(&desc, &job) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("desc.type is unknown (got 999)"));
  CHECK(nook_bake_job_wait(nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_bake_job_cancel(nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_bake_job_poll(nullptr, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_bake_job_file(nullptr, nullptr, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_bake_job_report(nullptr, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  nook_bake_job_destroy(nullptr);
  nook_bake_job_destroy(&job);
}
