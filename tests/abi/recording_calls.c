/* Every function of the header of recorded frames, called from C in the order a host would; returns the
 * number of failed expectations and prints each. */
#include <nook/experimental/nook_recording.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int nook_call_every_recording_function(void);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("recording_calls.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)
#define EXPECT_OK(call) expect((call) == NOOK_OK, #call, __LINE__)

enum { WIDTH = 4, HEIGHT = 3 };

int nook_call_every_recording_function(void) {
  const float projection[16] = {1.5f, 0, 0, 0, 0, 1.5f, 0, 0, 0, 0, -1, -1, 0, 0, -0.2f, 0};
  float depth[WIDTH * HEIGHT], ao[WIDTH * HEIGHT];
  nook_context_desc context_desc;
  nook_context context = NULL;
  nook_nnao_recording_desc desc, read;
  nook_nnao_recording recording = NULL, loaded = NULL;
  void *bytes, *again;
  size_t size = 0, room;
  int i;
  for (i = 0; i < WIDTH * HEIGHT; ++i) {
    depth[i] = 2.0f + 0.01f * (float)i;
    ao[i] = 0.5f;
  }
  EXPECT_OK(nook_context_desc_init(&context_desc));
  EXPECT_OK(nook_context_create(&context_desc, &context));
  EXPECT_OK(nook_nnao_recording_desc_init(&desc));
  desc.width = WIDTH;
  desc.height = HEIGHT;
  desc.depth = depth;
  desc.depth_kind = 1;
  desc.ao = ao;
  desc.radius = 0.5f;
  desc.renderer = "another interface";
  memcpy(desc.projection, projection, sizeof projection);
  EXPECT_OK(nook_nnao_recording_create(context, &desc, &recording));

  EXPECT_OK(nook_nnao_recording_save(recording, NULL, &size));
  bytes = malloc(size);
  again = malloc(size);
  room = size - 1;
  EXPECT(nook_nnao_recording_save(recording, bytes, &room) == NOOK_ERROR_INVALID_ARGUMENT);
  EXPECT(room == size);
  EXPECT_OK(nook_nnao_recording_save(recording, bytes, &size));

  EXPECT_OK(nook_nnao_recording_load(context, bytes, size, &loaded));
  nook_nnao_recording_destroy(&recording);
  memset(&read, 0, sizeof read);
  read.struct_size = sizeof read;
  EXPECT_OK(nook_nnao_recording_describe(loaded, &read));
  EXPECT(read.width == WIDTH && read.height == HEIGHT && read.radius == 0.5f && read.taps == 9);
  EXPECT(memcmp(read.depth, depth, sizeof depth) == 0 && memcmp(read.ao, ao, sizeof ao) == 0);
  EXPECT(read.normals == NULL && read.layer_texels == NULL && read.network != NULL);
  EXPECT(read.library_version == nook_version());
  EXPECT(strcmp(read.renderer, "another interface") == 0 && read.note[0] == 0);

  /* Its contents make an equal one. */
  EXPECT_OK(nook_nnao_recording_create(context, &read, &recording));
  EXPECT_OK(nook_nnao_recording_save(recording, again, &size));
  EXPECT(memcmp(bytes, again, size) == 0);
  free(bytes);
  free(again);
  nook_nnao_recording_destroy(&loaded);
  nook_nnao_recording_destroy(&recording);
  nook_nnao_recording_destroy(NULL);
  EXPECT(loaded == NULL && recording == NULL);
  nook_context_destroy(&context);
  return failures;
}
