// Baked clips through the public interface.
#include <nook/experimental/nook_stages.h>
#include <nook/experimental/nook_world_sample.h>
#include <nook/nook_clips.h>
#include <nook/nook_world.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/model_file.h"
#include "tests/abi/host.h"
#include "tests/catch.h"
#include "tests/character/clip_sample.h"

using namespace nook::test;

// The clips of nook_test_model_bytes.
std::vector<std::byte> nook_test_clips_bytes();
std::vector<std::byte> nook_test_clips_bytes() {
  return nook::write_clip_set(sample_clips(sample_model()).set);
}

namespace {

nook::CharacterModel casting_model() {
  nook::CharacterModel model = sample_model();
  Numbers numbers(6);
  add_world_casters(model, numbers);
  return model;
}

struct ClipStage {
  explicit ClipStage(int refuse_at = -1) {
    host.bytes = nook::write_character_model(plain);
    const nook_context_desc desc = host.context_desc();
    REQUIRE(nook_context_create(&desc, &context) == NOOK_OK);
    REQUIRE(nook_model_load(context, host.bytes.data(), host.bytes.size(), &model) == NOOK_OK);
    const nook_scene_desc scene_desc = Host::scene_desc();
    REQUIRE(nook_scene_create(context, &scene_desc, &scene) == NOOK_OK);
    for (nook_instance_id& id : ids) REQUIRE(nook_scene_add_instance(scene, model, &id) == NOOK_OK);
    bytes = nook::write_clip_set(sample.set);
    host.refuse_at = refuse_at < 0 ? -1 : host.allocations + refuse_at;
    loaded = nook_clips_load(context, model, bytes.data(), bytes.size(), &clips);
  }
  ~ClipStage() {
    nook_scene_destroy(&scene);
    nook_clips_destroy(&clips);
    nook_model_destroy(&model);
    nook_context_destroy(&context);
  }
  ClipStage(const ClipStage&) = delete;
  ClipStage& operator=(const ClipStage&) = delete;

  std::vector<float> ao(const nook_clip_time& time) const {
    std::vector<float> values(plain.file_to_welded.size(), -1.0f);
    REQUIRE(nook_clips_read_ao(clips, &time, NOOK_FORMAT_FLOAT, values.data(), std::uint32_t(values.size()),
                               0) == NOOK_OK);
    return values;
  }

  nook::CharacterModel plain = casting_model();
  ClipSample sample = sample_clips(plain);
  Host host;
  std::vector<std::byte> bytes;
  nook_context context = nullptr;
  nook_model model = nullptr;
  nook_scene scene = nullptr;
  nook_instance_id ids[2] = {0, 0};
  nook_clips clips = nullptr;
  nook_result loaded = NOOK_OK;
};

const nook_clip_time in_walk{1, NOOK_CLIP_CLAMP, 0.6};

bool message_has(const char* part) {
  return std::strstr(nook_last_message(), part) != nullptr;
}

}  // namespace

TEST_CASE("clips: a set describes its clips, and a time beyond the end goes around") {
  ClipStage stage;
  nook_clips_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_clips_describe(stage.clips, &info) == NOOK_OK);
  CHECK(info.clip_count == 2);
  CHECK(info.frame_count == 6);
  CHECK(info.mode_count == 8);
  CHECK(info.memory_bytes > 0);
  nook_clip_info clip{};
  clip.struct_size = sizeof clip;
  REQUIRE(nook_clips_describe_clip(stage.clips, 1, &clip) == NOOK_OK);
  CHECK(std::string(clip.name) == "walk");
  CHECK(clip.first_frame == 1);
  CHECK(clip.frame_count == 5);
  const nook_clip_time around{1, NOOK_CLIP_LOOP, 2.25};
  std::uint32_t frames[2] = {99, 99};
  float share = -1;
  REQUIRE(nook_clips_frames(stage.clips, &around, frames, &share) == NOOK_OK);
  CHECK(frames[0] == 1);
  CHECK(frames[1] == 2);
  CHECK(share == 0.5f);
}

TEST_CASE("clips: a scene keeps the clips of its instances alive") {
  ClipStage stage;
  REQUIRE(nook_scene_set_clip(stage.scene, stage.ids[0], stage.clips, &in_walk, nullptr) == NOOK_OK);
  const std::vector<float> wanted = stage.ao(in_walk);
  nook_clips_destroy(&stage.clips);
  CHECK(stage.clips == nullptr);
  REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
  std::vector<float> ao(wanted.size());
  REQUIRE(nook_scene_read(stage.scene, stage.ids[0], NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao.data(),
                          std::uint32_t(ao.size()), 0) == NOOK_OK);
  CHECK(ao == wanted);
}

TEST_CASE("clips: the AO of a time follows the formula, in every format and with a stride") {
  ClipStage stage;
  REQUIRE(stage.loaded == NOOK_OK);
  const std::vector<float> ao = stage.ao(in_walk);
  std::vector<unsigned char> bytes(8 * ao.size(), 0xcd);
  REQUIRE(nook_clips_read_ao(stage.clips, &in_walk, NOOK_FORMAT_UNORM8, bytes.data(),
                             std::uint32_t(ao.size()), 8) == NOOK_OK);
  for (std::size_t i = 0; i < ao.size(); ++i) {
    // 0.6 s is 1.2 frames from the first of the clip, which is frame 1 of the set.
    CHECK(std::abs(double(ao[i]) - sample_ao(stage.sample.set, 2, 3, 0.2, stage.plain.file_to_welded[i])) <
          1e-5);
    CHECK(std::abs(float(bytes[8 * i]) / 255 - ao[i]) <= 1.0f / 510 + 1e-6f);
    CHECK(bytes[8 * i + 1] == 0xcd);
  }
}

TEST_CASE("clips: an instance takes AO and pose of its clip, as one with the same bones and the same AO") {
  ClipStage stage;
  const float place[12] = {0, 0, 1, 0.4f, 0, 1, 0, 0, -1, 0, 0, 0.1f};
  REQUIRE(nook_scene_set_clip(stage.scene, stage.ids[0], stage.clips, &in_walk, nullptr) == NOOK_OK);
  const auto bone_count = std::uint32_t(stage.plain.bone_count());
  std::vector<float> bones(12 * bone_count);
  REQUIRE(nook_clips_read_pose(stage.clips, &in_walk, place, bones.data(), bone_count) == NOOK_OK);
  REQUIRE(nook_scene_link(stage.scene, stage.ids[0], stage.ids[1]) == NOOK_OK);
  const auto count = std::uint32_t(stage.plain.file_to_welded.size());
  std::vector<float> by_bones(count), by_clip(count);
  REQUIRE(nook::test::set_rows(stage.scene, stage.ids[1], bones.data(), bone_count) == NOOK_OK);
  REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
  REQUIRE(nook_scene_read(stage.scene, stage.ids[0], NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, by_bones.data(),
                          count, 0) == NOOK_OK);
  REQUIRE(nook_scene_set_clip(stage.scene, stage.ids[1], stage.clips, &in_walk, place) == NOOK_OK);
  REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
  REQUIRE(nook_scene_read(stage.scene, stage.ids[0], NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, by_clip.data(),
                          count, 0) == NOOK_OK);
  CHECK(by_bones == by_clip);
  CHECK(by_clip != stage.ao(in_walk));
}

TEST_CASE("clips: the casters of a time match the pose") {
  ClipStage stage;
  // At a frame: between two, a bone that turns by an angle shrinks by the cosine of half of it.
  const nook_clip_time at_frame{1, NOOK_CLIP_CLAMP, 0.5};
  nook_capsule casters[NOOK_WORLD_MAX_CASTERS];
  std::uint32_t count = NOOK_WORLD_MAX_CASTERS;
  const float place[12] = {2, 0, 0, 3, 0, 2, 0, 0, 0, 0, 2, 0};
  REQUIRE(nook_clips_read_capsules(stage.clips, &at_frame, place, casters, &count) == NOOK_OK);
  REQUIRE(count == stage.plain.world_casters.size());
  std::vector<float> bones(12 * stage.plain.bone_count());
  REQUIRE(nook_clips_read_pose(stage.clips, &at_frame, place, bones.data(),
                               std::uint32_t(stage.plain.bone_count())) == NOOK_OK);
  nook_model_capsule rest[NOOK_WORLD_MAX_CASTERS];
  std::uint32_t rest_count = NOOK_WORLD_MAX_CASTERS;
  REQUIRE(nook_model_read_capsules(stage.model, rest, &rest_count) == NOOK_OK);
  for (std::uint32_t i = 0; i < count; ++i) {
    const float* m = &bones[12 * rest[i].bone];
    const float* a = rest[i].capsule.a;
    // The place doubles lengths. The scale comes from 16-bit numbers of a step of 2e-5 m on 0.05 to 0.2 m.
    CHECK(std::abs(casters[i].radius_a - 2 * rest[i].ao_scale * rest[i].capsule.radius_a) < 1e-4f);
    for (int r = 0; r < 3; ++r)
      CHECK(std::abs(casters[i].a[r] -
                     (m[4 * r] * a[0] + m[4 * r + 1] * a[1] + m[4 * r + 2] * a[2] + m[4 * r + 3])) < 1e-5f);
  }
}

TEST_CASE("clips: times, clips and places that are out of range are refused") {
  ClipStage stage;
  std::uint32_t frames[2];
  float share = 0;
  const auto refused = [&](nook_clip_time time) {
    return nook_clips_frames(stage.clips, &time, frames, &share) == NOOK_ERROR_INVALID_ARGUMENT &&
           nook_scene_set_clip(stage.scene, stage.ids[0], stage.clips, &time, nullptr) ==
               NOOK_ERROR_INVALID_ARGUMENT;
  };
  CHECK(refused({1, NOOK_CLIP_LOOP, NAN}));
  CHECK(message_has("time.seconds"));
  CHECK(refused({1, NOOK_CLIP_CLAMP, -INFINITY}));
  CHECK(refused({2, NOOK_CLIP_LOOP, 0}));
  CHECK(message_has("got 2, need less than 2"));
  CHECK(refused({1, 7, 0}));
  float place[12] = {1, 0, 0, NAN, 0, 1, 0, 0, 0, 0, 1, 0};
  CHECK(nook_scene_set_clip(stage.scene, stage.ids[0], stage.clips, &in_walk, place) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("place_3x4"));
  CHECK(nook_scene_set_clip(stage.scene, 77, stage.clips, &in_walk, nullptr) == NOOK_ERROR_INVALID_HANDLE);
  float ao = 0;
  CHECK(nook_clips_read_ao(stage.clips, &in_walk, NOOK_FORMAT_FLOAT, &ao, 1, 0) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_clips_read_ao(stage.clips, nullptr, NOOK_FORMAT_FLOAT, &ao, 1, 0) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  nook_clips none = stage.clips;
  CHECK(nook_clips_load(stage.context, stage.model, stage.bytes.data(), 100, &none) == NOOK_ERROR_BAD_FILE);
  CHECK(none == nullptr);
}

TEST_CASE("clips: a model without world casters has none to read") {
  ClipStage stage;
  const nook::CharacterModel bare = sample_model();
  const std::vector<std::byte> model_bytes = nook::write_character_model(bare);
  nook_model model = nullptr;
  REQUIRE(nook_model_load(stage.context, model_bytes.data(), model_bytes.size(), &model) == NOOK_OK);
  nook_clips clips = nullptr;
  REQUIRE(nook_clips_load(stage.context, model, stage.bytes.data(), stage.bytes.size(), &clips) == NOOK_OK);
  nook_capsule caster;
  std::uint32_t count = 1;
  CHECK(nook_clips_read_capsules(clips, &in_walk, nullptr, &caster, &count) == NOOK_ERROR_UNSUPPORTED);
  CHECK(count == 0);
  nook_clips_destroy(&clips);
  nook_model_destroy(&model);
}

TEST_CASE("clips: every refused allocation of a load is reported, and nothing leaks") {
  int succeeded_at = -1;
  for (int n = 0; succeeded_at < 0 && n < 200; ++n) {
    ClipStage stage(n);
    if (stage.loaded == NOOK_OK) {
      succeeded_at = n;
    } else {
      CHECK(stage.loaded == NOOK_ERROR_OUT_OF_MEMORY);
      CHECK(stage.clips == nullptr);
    }
  }
  CHECK(succeeded_at > 5);
}

TEST_CASE("clips: frames in a scene do not allocate after the first") {
  ClipStage stage;
  const auto count = std::uint32_t(stage.plain.file_to_welded.size());
  std::vector<float> ao(count), bones(12 * stage.plain.bone_count());
  const auto frame = [&](double seconds) {
    const nook_clip_time time{1, NOOK_CLIP_LOOP, seconds};
    for (const nook_instance_id id : stage.ids)
      CHECK(nook_scene_set_clip(stage.scene, id, stage.clips, &time, nullptr) == NOOK_OK);
    CHECK(nook_scene_update(stage.scene) == NOOK_OK);
    CHECK(nook_scene_read(stage.scene, stage.ids[0], NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao.data(), count,
                          0) == NOOK_OK);
    CHECK(nook_clips_read_ao(stage.clips, &time, NOOK_FORMAT_FLOAT, ao.data(), count, 0) == NOOK_OK);
    CHECK(nook_clips_read_pose(stage.clips, &time, nullptr, bones.data(),
                               std::uint32_t(stage.plain.bone_count())) == NOOK_OK);
  };
  frame(0.1);
  const int before = stage.host.allocations;
  for (int i = 0; i < 20; ++i) frame(0.13 * i);
  CHECK(stage.host.allocations == before);
}

TEST_CASE("clips: the textures hold modes and weights whose sum is the AO") {
  ClipStage stage;
  std::uint32_t width = 0, height = 0;
  std::size_t size = 0;
  REQUIRE(nook_clips_read_table(stage.clips, NOOK_CLIPS_MODES, nullptr, &size, &width, &height) == NOOK_OK);
  CHECK(width == 2048);
  std::vector<std::int8_t> modes(size);
  REQUIRE(nook_clips_read_table(stage.clips, NOOK_CLIPS_MODES, modes.data(), &size, &width, &height) ==
          NOOK_OK);
  REQUIRE(nook_clips_read_table(stage.clips, NOOK_CLIPS_WEIGHTS, nullptr, &size, &width, &height) == NOOK_OK);
  CHECK(size == std::size_t(8) * width * height);
  std::vector<std::int8_t> weights(size--);
  CHECK(nook_clips_read_table(stage.clips, NOOK_CLIPS_WEIGHTS, weights.data(), &size, &width, &height) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  const std::size_t modes_of_vertex = stage.sample.set.ao.modes;
  for (std::size_t i = 0; i < stage.plain.file_to_welded.size(); ++i)
    for (std::size_t k = 0; k < modes_of_vertex; ++k)
      REQUIRE(modes[i * modes_of_vertex + k] ==
              stage.sample.set.ao.mode[k * stage.sample.set.ao.rows + stage.plain.file_to_welded[i]]);
}
