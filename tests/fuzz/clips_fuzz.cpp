// Loads bytes as baked clips of a small character and uses them through the C ABI: nothing may crash, and AO
// lies in [0, 1], whatever the bytes.
#include <nook/experimental/nook_world_sample.h>
#include <nook/nook_clips.h>
#include <nook/nook_world.h>

#include <vector>

#include "sdk/src/character/model_file.h"
#include "tests/fuzz/clips_model.h"
#include "tests/fuzz/container_input.h"
#include "tests/fuzz/library.h"

namespace {

using namespace nook::test;

nook_model model_of_clips() {
  static nook_model made = nullptr;
  if (made) return made;
  const std::vector<std::byte> bytes = nook::write_character_model(clips_model());
  require(ok(nook_model_load(context_with_jobs(false), bytes.data(), bytes.size(), &made)));
  return made;
}

void use(nook_clips clips, Script& script) {
  nook_clips_info info{};
  info.struct_size = sizeof info;
  require(ok(nook_clips_describe(clips, &info)) && info.clip_count > 0 && info.frame_count > 0);
  nook_clip_time time{script.below(info.clip_count + 1), nook_clip_wrap(script.below(3)),
                      double(script.number())};
  uint32_t frames[2] = {0, 0};
  float share = 0;
  if (ok(nook_clips_frames(clips, &time, frames, &share)))
    require(frames[0] < info.frame_count && frames[1] < info.frame_count && share >= 0 && share < 1);
  std::vector<float> ao(info.file_vertex_count, -1.0f), bones(std::size_t(12) * info.bone_count);
  if (ok(nook_clips_read_ao(clips, &time, NOOK_FORMAT_FLOAT, ao.data(), info.file_vertex_count, 0)))
    for (const float value : ao) require(value >= 0 && value <= 1);
  float place[12];
  for (float& number : place) number = script.number();
  const float* const at = script.below(2) ? place : nullptr;
  ok(nook_clips_read_pose(clips, &time, at, bones.data(), info.bone_count));
  nook_capsule casters[NOOK_WORLD_MAX_CASTERS];
  uint32_t count = NOOK_WORLD_MAX_CASTERS;
  ok(nook_clips_read_capsules(clips, &time, at, casters, &count));

  nook_scene_desc desc;
  require(ok(nook_scene_desc_init(&desc)));
  nook_scene scene = nullptr;
  require(ok(nook_scene_create(context_with_jobs(false), &desc, &scene)));
  nook_instance_id ids[2] = {0, 0};
  for (nook_instance_id& id : ids) {
    require(ok(nook_scene_add_instance(scene, model_of_clips(), &id)));
    ok(nook_scene_set_clip(scene, id, clips, &time, at));
  }
  require(ok(nook_scene_link(scene, ids[0], ids[1])));
  require(ok(nook_scene_update(scene)));
  require(ok(nook_scene_read(scene, ids[0], NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao.data(),
                             info.file_vertex_count, 0)));
  for (const float value : ao) require(value >= 0 && value <= 1);
  nook_scene_destroy(&scene);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ContainerInput input = split_input(data, size);
  nook_clips clips = nullptr;
  if (!ok(nook_clips_load(context_with_jobs(input.script.byte() & 1), model_of_clips(), input.file.data(),
                          input.file.size(), &clips))) {
    require(clips == nullptr);
    return 0;
  }
  use(clips, input.script);
  nook_clips_destroy(&clips);
  return 0;
}
