/* Every function of nook_gl_world.h, called from C; returns the number of failed expectations and prints
 * each. The OpenGL context is current. */
#include <nook/nook_gl_world.h>
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

int nook_gl_world_call_everything(nook_gl gl) {
  nook_world_pass_desc desc;
  nook_world_frame_desc frame;
  nook_world_pass_info info;
  nook_world_pass pass = NULL;
  failures = 0;
  EXPECT(nook_world_pass_desc_init(&desc, sizeof desc, NOOK_VERSION) == NOOK_OK);
  desc.max_width = desc.max_height = 16;
  EXPECT(nook_world_pass_create(gl, &desc, &pass) == NOOK_OK);
  EXPECT(nook_world_frame_desc_init(&frame, sizeof frame, NOOK_VERSION) == NOOK_OK);
  EXPECT(nook_world_render(pass, &frame) == NOOK_ERROR_INVALID_ARGUMENT);
  EXPECT(nook_world_recheck(pass) == NOOK_OK);
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  EXPECT(nook_world_pass_describe(pass, &info) == NOOK_OK);
  EXPECT(info.texture != 0 && info.caster_texture != 0 && info.caster_count == 0 && info.texture_bytes > 256);
  EXPECT(info.glsl != NULL && strstr(info.glsl, "float nook_world_open(vec3 point, vec3 normal)") != NULL);
  nook_world_pass_destroy(&pass);
  EXPECT(pass == NULL);
  return failures;
}
