// A tube with clips, and its model from a bake of a second.
#pragma once

#include <string>

#include "tests/bakers/api/handles.h"
#include "tests/bakers/tool/glb_tube.h"
#include "tests/catch.h"

inline Character tube_with_clips() {
  const std::string glb = glb_tube({"bend", "T-pose", "wave"});
  nook_bake_source_desc desc;
  REQUIRE(nook_bake_source_desc_init(&desc) == NOOK_OK);
  desc.bytes = glb.data();
  desc.byte_count = glb.size();
  nook_bake_character character = nullptr;
  REQUIRE(nook_bake_character_create(&desc, &character) == NOOK_OK);
  return Character(character);
}

inline std::string bytes_of(nook_bake_job job) {
  INFO(nook_bake_last_message());
  REQUIRE(nook_bake_job_wait(job) == NOOK_OK);
  const void* bytes = nullptr;
  std::size_t size = 0;
  REQUIRE(nook_bake_job_file(job, &bytes, &size) == NOOK_OK);
  return {static_cast<const char*>(bytes), size};
}

inline std::string model_of(const Character& character) {
  nook_bake_character_desc desc;
  REQUIRE(nook_bake_character_desc_init(&desc) == NOOK_OK);
  desc.character = character.get();
  desc.preset = NOOK_BAKE_PRESET_DRAFT;
  desc.pose_mode = NOOK_BAKE_POSES_AUTO;
  // Most of the time of so small a bake goes to its casters, by the number of poses.
  desc.auto_pose_count = 8;
  desc.spheres = 8;
  desc.key_points = 24;
  desc.rays = 4;
  desc.steps = 40;
  nook_bake_job job = nullptr;
  REQUIRE(nook_bake_start_character(&desc, &job) == NOOK_OK);
  const Job owner(job);
  return bytes_of(job);
}

// The result of starting a job, which is destroyed; there is one exactly where it started.
template <class Desc>
nook_result start_result_of(const Character& character, Desc desc) {
  desc.character = character.get();
  nook_bake_job job = nullptr;
  const nook_result result = nook_bake_start(&desc, &job);
  CHECK((job != nullptr) == (result == NOOK_OK));
  nook_bake_job_destroy(&job);
  return result;
}
