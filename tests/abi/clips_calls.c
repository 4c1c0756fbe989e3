/* Every function of nook_clips.h, called from C; returns the number of failed expectations and prints each.
 */
#include <nook/experimental/nook_stages.h>
#include <nook/experimental/nook_world_sample.h>
#include <nook/nook_clips.h>
#include <nook/nook_world.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int nook_clips_call_everything(nook_context context, nook_model model, nook_scene scene,
                               nook_instance_id instance, const void* bytes, size_t size);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("clips_calls.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)
#define EXPECT_OK(call) expect((call) == NOOK_OK, #call, __LINE__)

static void read_tables(nook_clips clips) {
  nook_clips_table table;
  for (table = NOOK_CLIPS_MODES; table <= NOOK_CLIPS_WEIGHTS; ++table) {
    uint32_t width = 0, height = 0;
    size_t size = 0;
    void* texels;
    EXPECT_OK(nook_clips_read_table(clips, table, NULL, &size, &width, &height));
    EXPECT(width > 0 && height > 0 && size == (size_t)width * height * (table == NOOK_CLIPS_MODES ? 4 : 8));
    texels = malloc(size);
    EXPECT_OK(nook_clips_read_table(clips, table, texels, &size, &width, &height));
    --size;
    EXPECT(nook_clips_read_table(clips, table, texels, &size, &width, &height) ==
           NOOK_ERROR_INVALID_ARGUMENT);
    free(texels);
  }
}

int nook_clips_call_everything(nook_context context, nook_model model, nook_scene scene,
                               nook_instance_id instance, const void* bytes, size_t size) {
  nook_clips clips = NULL;
  nook_clips_info info;
  nook_clip_info clip;
  nook_clip_time time;
  nook_capsule casters[NOOK_WORLD_MAX_CASTERS];
  uint32_t walk = 0, frames[2] = {99, 99}, count = NOOK_WORLD_MAX_CASTERS, i;
  float share = -1, *ao, *bones;
  const float place[12] = {1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0};
  failures = 0;
  EXPECT_OK(nook_clips_load(context, model, bytes, size, &clips));
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  EXPECT_OK(nook_clips_describe(clips, &info));
  EXPECT(info.clip_count == 2 && info.frame_count == 6 && info.mode_count == 8 && info.memory_bytes > 0);
  memset(&clip, 0, sizeof clip);
  clip.struct_size = sizeof clip;
  while (walk < info.clip_count && nook_clips_describe_clip(clips, walk, &clip) == NOOK_OK &&
         strcmp(clip.name, "walk") != 0)
    ++walk;
  EXPECT(walk < info.clip_count);
  EXPECT_OK(nook_clips_describe_clip(clips, walk, &clip));
  EXPECT(strcmp(clip.name, "walk") == 0 && clip.first_frame == 1 && clip.frame_count == 5);
  time.clip = walk;
  time.wrap = NOOK_CLIP_LOOP;
  time.seconds = 2.25;
  EXPECT_OK(nook_clips_frames(clips, &time, frames, &share));
  EXPECT(frames[0] == 1 && frames[1] == 2 && share == 0.5f);
  ao = (float*)malloc(info.file_vertex_count * sizeof(float));
  bones = (float*)malloc(12 * info.bone_count * sizeof(float));
  EXPECT_OK(nook_clips_read_ao(clips, &time, NOOK_FORMAT_FLOAT, ao, info.file_vertex_count, 0));
  for (i = 0; i < info.file_vertex_count; ++i) EXPECT(ao[i] >= 0 && ao[i] <= 1);
  EXPECT_OK(nook_clips_read_pose(clips, &time, place, bones, info.bone_count));
  EXPECT_OK(nook_clips_read_capsules(clips, &time, place, casters, &count));
  EXPECT(count > 0 && casters[0].radius_a > 0);
  EXPECT_OK(nook_scene_set_clip(scene, instance, clips, &time, place));
  EXPECT_OK(nook_scene_update(scene));
  EXPECT_OK(
      nook_scene_read(scene, instance, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao, info.file_vertex_count, 0));
  read_tables(clips);
  free(ao);
  free(bones);
  /* The scene keeps the clips alive. */
  nook_clips_destroy(&clips);
  EXPECT(!clips);
  EXPECT_OK(nook_scene_update(scene));
  return failures;
}
