/* The functions of bent normals, called from C; returns the number of failed expectations and prints each. */
#include <nook/nook_character.h>
#include <stdio.h>
#include <stdlib.h>

int nook_bent_call_everything(nook_model model, nook_scene scene, nook_instance_id instance);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("bent_calls.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)

int nook_bent_call_everything(nook_model model, nook_scene scene, nook_instance_id instance) {
  nook_model_info info;
  int8_t* bytes;
  failures = 0;
  info.struct_size = sizeof info;
  EXPECT(nook_model_describe(model, &info) == NOOK_OK);
  bytes = (int8_t*)malloc(8 * (size_t)info.file_vertex_count);
  EXPECT(nook_model_read(model, NOOK_MODEL_OCCLUDED_DIRECTIONS, bytes, info.file_vertex_count, 0) == NOOK_OK);
  EXPECT(bytes[3] == 0 && bytes[7] == 0);
  EXPECT(nook_scene_read(scene, instance, NOOK_CHANNEL_BENT_NORMAL, NOOK_FORMAT_SNORM8, bytes,
                         info.file_vertex_count, 8) == NOOK_OK);
  EXPECT(bytes[3] >= 0);
  free(bytes);
  return failures;
}
