/* Every function of nook_world.h and nook_nnao.h, and the experimental ones that belong to a screen pass,
 * called from C; returns the number of failed expectations and prints each. The OpenGL context is current. */
#include <nook/experimental/nook_recording.h>
#include <nook/experimental/nook_stages.h>
#include <nook/nook_nnao.h>
#include <nook/nook_world.h>
#include <stdio.h>
#include <string.h>

int nook_gl_world_call_everything(nook_gl gl);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("world_every_function.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)

static void call_screen_pass(nook_gl gl) {
  nook_nnao_desc desc;
  nook_gl_frame_desc frame;
  nook_nnao_frame_desc settings;
  nook_nnao_info info;
  nook_nnao_timings timings;
  nook_nnao_recording recording = NULL;
  nook_nnao pass = NULL;
  uint64_t bytes = 0;
  EXPECT(nook_nnao_desc_init(&desc) == NOOK_OK);
  desc.preset = NOOK_NNAO_PRESET_FAST;
  desc.max_width = desc.max_height = 16;
  EXPECT(nook_nnao_memory(&desc, &bytes) == NOOK_OK && bytes > 0);
  EXPECT(nook_nnao_create(gl, &desc, &pass) == NOOK_OK);
  EXPECT(nook_gl_frame_desc_init(&frame) == NOOK_OK);
  EXPECT(nook_nnao_frame_desc_init(&settings) == NOOK_OK);
  /* The frame has no size and no depth yet. */
  EXPECT(nook_nnao_render(pass, &frame, &settings) == NOOK_ERROR_INVALID_ARGUMENT);
  EXPECT(nook_nnao_record(pass, &frame, &settings, NULL, &recording) == NOOK_ERROR_INVALID_ARGUMENT);
  EXPECT(recording == NULL);
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  EXPECT(nook_nnao_describe(pass, &info) == NOOK_OK && info.texture != 0);
  memset(&timings, 0, sizeof timings);
  timings.struct_size = sizeof timings;
  EXPECT(nook_nnao_read_timings(pass, &timings) == NOOK_OK && timings.valid == 0);
  nook_nnao_destroy(&pass);
  EXPECT(pass == NULL);
}

int nook_gl_world_call_everything(nook_gl gl) {
  nook_world_desc desc;
  nook_gl_frame_desc frame;
  nook_world_frame_desc frame_desc;
  nook_world_info info;
  nook_world pass = NULL;
  failures = 0;
  call_screen_pass(gl);
  EXPECT(nook_world_desc_init(&desc) == NOOK_OK);
  desc.max_width = desc.max_height = 16;
  EXPECT(nook_world_create(gl, &desc, &pass) == NOOK_OK);
  EXPECT(nook_gl_frame_desc_init(&frame) == NOOK_OK);
  EXPECT(nook_world_frame_desc_init(&frame_desc) == NOOK_OK);
  EXPECT(nook_world_render(pass, &frame, &frame_desc) == NOOK_ERROR_INVALID_ARGUMENT);
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  EXPECT(nook_world_describe(pass, &info) == NOOK_OK);
  EXPECT(info.texture != 0 && info.caster_texture != 0 && info.caster_count == 0 && info.texture_bytes > 256);
  EXPECT(info.glsl != NULL && strstr(info.glsl, "float nook_world_open(vec3 point, vec3 normal)") != NULL);
  nook_world_destroy(&pass);
  EXPECT(pass == NULL);
  return failures;
}
