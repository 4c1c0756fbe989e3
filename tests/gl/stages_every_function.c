/* Every function of nook_stages.h, called from C in the order a host would; returns the number of failed
 * expectations and prints each. No OpenGL context is needed. */
#include <nook/experimental/nook_stages.h>
#include <stdio.h>
#include <string.h>

int nook_call_every_stages_function(void);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("stages_every_function.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)
#define EXPECT_OK(call) expect((call) == NOOK_OK, #call, __LINE__)

int nook_call_every_stages_function(void) {
  const float projection[16] = {1.5f, 0, 0, 0, 0, 1.5f, 0, 0, 0, 0, -1, -1, 0, 0, -0.2f, 0};
  nook_context_desc context_desc;
  nook_context context = NULL;
  nook_nnao_desc desc;
  nook_gl_frame_desc frame;
  nook_nnao_frame_desc frame_desc;
  nook_nnao_stages stages = NULL;
  nook_nnao_stages_info info;
  nook_nnao_stage_info stage;
  nook_nnao_image_info image;
  nook_nnao_frame_values values;
  uint32_t i;
  EXPECT_OK(nook_context_desc_init(&context_desc));
  EXPECT_OK(nook_context_create(&context_desc, &context));
  EXPECT_OK(nook_nnao_desc_init(&desc));
  desc.max_width = 64;
  desc.max_height = 48;
  EXPECT_OK(nook_nnao_stages_create(context, &desc, &stages));
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  EXPECT_OK(nook_nnao_stages_describe(stages, &info));
  EXPECT(info.stage_count == 5 && info.vertex_shader && info.network && info.network_bytes % 16 == 0);
  for (i = 0; i < info.stage_count; ++i) {
    memset(&stage, 0, sizeof stage);
    stage.struct_size = sizeof stage;
    EXPECT_OK(nook_nnao_stages_describe_stage(stages, i, &stage));
    EXPECT(stage.fragment_shader && strncmp(stage.fragment_shader, "#version 450", 12) == 0);
    memset(&image, 0, sizeof image);
    image.struct_size = sizeof image;
    EXPECT_OK(nook_nnao_stages_describe_image(stages, stage.output, &image));
    EXPECT(image.format != NOOK_NNAO_FORMAT_NONE && image.width == 64 && image.height == 48);
  }
  EXPECT_OK(nook_gl_frame_desc_init(&frame));
  EXPECT_OK(nook_nnao_frame_desc_init(&frame_desc));
  frame.width = 64;
  frame.height = 48;
  frame_desc.radius = 0.5f;
  memcpy(frame.projection, projection, sizeof projection);
  memset(&values, 0, sizeof values);
  values.struct_size = sizeof values;
  EXPECT_OK(nook_nnao_stages_frame(stages, &frame, &frame_desc, NULL, 0, 0, &values));
  EXPECT(values.surface_width == 64 && values.viewport[3] == 48);
  nook_nnao_stages_destroy(&stages);
  EXPECT(stages == NULL);
  nook_context_destroy(&context);
  return failures;
}
