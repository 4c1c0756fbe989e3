// Keys of bakes before they run.
#include <nook/experimental/nook_bake_key.h>

#include <algorithm>
#include <string>

#include "tests/bakers/api/baked_tube.h"
#include "tests/catch.h"

namespace {

template <class Desc>
std::string key_of(const Desc& desc) {
  char key[NOOK_BAKE_KEY_SIZE] = "";
  const nook_result result = nook_bake_key(&desc, key, sizeof key);
  INFO(nook_bake_last_message());
  REQUIRE(result == NOOK_OK);
  const std::string text = key;
  REQUIRE(text.size() == 64);
  REQUIRE(text.find_first_not_of("0123456789abcdef") == std::string::npos);
  return text;
}

nook_bake_character_desc draft_of(const Character& character) {
  nook_bake_character_desc desc;
  REQUIRE(nook_bake_character_desc_init(&desc) == NOOK_OK);
  desc.character = character.get();
  desc.preset = NOOK_BAKE_PRESET_DRAFT;
  return desc;
}

}  // namespace

TEST_CASE("a key follows settings and content, and not threads or handles") {
  const Character character = tube_with_clips(), again = tube_with_clips(), other = tube_character();
  const nook_bake_character_desc desc = draft_of(character);
  const std::string key = key_of(desc);
  nook_bake_character_desc same = draft_of(again);
  same.threads = 3;
  CHECK(key_of(same) == key);
  CHECK(key_of(draft_of(other)) != key);
  nook_bake_character_desc gamma = desc, learned = desc, seed = desc;
  gamma.gamma = 1.5f;
  learned.gamma = NOOK_BAKE_GAMMA_LEARNED;
  seed.seed = 2;
  std::string keys[] = {key, key_of(gamma), key_of(learned), key_of(seed)};
  std::sort(std::begin(keys), std::end(keys));
  CHECK(std::adjacent_find(std::begin(keys), std::end(keys)) == std::end(keys));
  // The poses of the host count with every number.
  float poses[2][2][12] = {};
  for (auto& pose : poses)
    for (auto& bone : pose) bone[0] = bone[5] = bone[10] = 1;
  nook_bake_character_desc extra = draft_of(other);
  extra.pose_mode = NOOK_BAKE_POSES_EXTRA;
  extra.extra_poses_3x4 = &poses[0][0][0];
  extra.extra_pose_count = 2;
  const std::string rest = key_of(extra);
  poses[1][1][3] = 0.25f;
  CHECK(key_of(extra) != rest);
}

TEST_CASE("bakes that begin with a model have keys that follow it") {
  const Character character = tube_with_clips();
  std::string model = model_of(character);
  nook_bake_bent_desc bent;
  REQUIRE(nook_bake_bent_desc_init(&bent) == NOOK_OK);
  bent.character = character.get();
  bent.model = model.data();
  bent.model_size = model.size();
  nook_bake_clips_desc clips;
  REQUIRE(nook_bake_clips_desc_init(&clips) == NOOK_OK);
  clips.character = character.get();
  clips.model = model.data();
  clips.model_size = model.size();
  CHECK(key_of(bent) != key_of(clips));
  bent.rays += 1;
  const std::string more = key_of(bent);
  bent.rays -= 1;
  CHECK(key_of(bent) != more);
}

TEST_CASE("faults of a key name their cause") {
  const Character character = tube_character();
  const nook_bake_character_desc desc = draft_of(character);
  char key[NOOK_BAKE_KEY_SIZE] = "kept";
  CHECK(nook_bake_key(&desc, key, sizeof key - 1) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(std::string(nook_bake_last_message()).find("got 64, need 65") != std::string::npos);
  CHECK(nook_bake_key(&desc, nullptr, sizeof key) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_bake_key(nullptr, key, sizeof key) == NOOK_ERROR_INVALID_ARGUMENT);
  nook_bake_source_desc source;
  REQUIRE(nook_bake_source_desc_init(&source) == NOOK_OK);
  CHECK(nook_bake_key(&source, key, sizeof key) == NOOK_ERROR_INVALID_ARGUMENT);
  nook_bake_character_desc bad = desc;
  bad.preset = 99;
  CHECK(nook_bake_key(&bad, key, sizeof key) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(std::string(key) == "kept");
}
