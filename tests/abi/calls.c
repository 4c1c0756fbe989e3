/* Every function of the base and character headers, called from C in the order a host would; returns the
 * number of failed expectations and prints each. bytes: a character model. */
#include <nook/experimental/nook_debug.h>
#include <nook/nook_character.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int nook_call_everything(const void* bytes, size_t size);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("calls.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)
#define EXPECT_OK(call) expect((call) == NOOK_OK, #call, __LINE__)

static void* allocate(void* user, size_t size, size_t alignment) {
  ++*(int*)user;
  return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}
static void release(void* user, void* memory, size_t size, size_t alignment) {
  (void)size;
  (void)alignment;
  --*(int*)user;
  free(memory);
}
static void log_text(void* user, nook_log_severity severity, const char* text) {
  if (severity == NOOK_LOG_INFO && text[0]) ++*(int*)user;
}
static void parallel(void* user, uint32_t count, nook_job_fn body, void* body_user) {
  uint32_t i;
  ++*(int*)user;
  for (i = count; i-- > 0;) body(body_user, i);
}

static float* rest_pose(uint32_t bones) {
  float* pose = (float*)calloc(bones, 12 * sizeof(float));
  uint32_t i;
  for (i = 0; i < bones; ++i) pose[12 * i] = pose[12 * i + 5] = pose[12 * i + 10] = 1;
  return pose;
}

int nook_call_everything(const void* bytes, size_t size) {
  int blocks = 0, lines = 0, jobs = 0;
  nook_context_desc context_desc;
  nook_scene_desc scene_desc;
  nook_pose_desc pose_desc;
  nook_context context = NULL;
  nook_model model = NULL;
  nook_model_info info;
  nook_scene scene = NULL;
  nook_scene_info stats;
  nook_instance_id a = 0, b = 0;
  nook_occluder_id occluder = 0;
  nook_range range = {9, 0};
  nook_occluder ball = {{0, 2, 0}, 0.5f, 0};
  float *pose, *ao;
  const float plane[4] = {0, 1, 0, -1}, centre[3] = {0, 2, 0};
  const nook_lobe lobe = {{0, 1, 0}, 2, {1, 1, 1}, 0};
  float* colour;
  unsigned char byte;

  failures = 0;
  EXPECT(nook_version() == NOOK_VERSION);
  EXPECT(nook_version_text()[0] - '0' == NOOK_VERSION_MAJOR &&
         strstr(nook_version_text(), NOOK_VERSION_SUFFIX));
  EXPECT(strcmp(nook_result_name(NOOK_OK), "NOOK_OK") == 0);
  EXPECT_OK(nook_context_desc_init(&context_desc));
  context_desc.allocator.user = &blocks;
  context_desc.allocator.allocate = allocate;
  context_desc.allocator.release = release;
  context_desc.log = log_text;
  context_desc.log_user = &lines;
  context_desc.parallel_for = parallel;
  context_desc.parallel_for_user = &jobs;
  EXPECT_OK(nook_context_create(&context_desc, &context));
  EXPECT_OK(nook_model_load(context, bytes, size, &model));
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  EXPECT_OK(nook_model_describe(model, &info));
  EXPECT(info.bone_count > 0 && info.file_vertex_count >= info.vertex_count && info.lod_count >= 1);
  EXPECT(info.model_bytes > 0 && info.instance_bytes > 0 && info.lit_instance_bytes > info.instance_bytes);
  EXPECT(nook_model_bone_name(model, 0) != NULL);
  EXPECT(nook_model_bone_name(model, info.bone_count) == NULL);
  EXPECT_OK(nook_model_describe_primitive(model, 0, &range));
  EXPECT(range.first == 0 && range.count > 0);
  pose = rest_pose(info.bone_count);
  ao = (float*)malloc(info.file_vertex_count * sizeof(float));
  EXPECT_OK(nook_model_read(model, NOOK_MODEL_STATIC_AO, ao, info.file_vertex_count, 0));
  EXPECT_OK(nook_scene_desc_init(&scene_desc));
  EXPECT_OK(nook_scene_create(context, &scene_desc, &scene));
  EXPECT_OK(nook_scene_add_instance(scene, model, &a));
  EXPECT_OK(nook_scene_add_instance(scene, model, &b));
  EXPECT_OK(nook_pose_desc_init(&pose_desc));
  pose_desc.kind = NOOK_POSE_REST_TO_WORLD;
  pose_desc.layout = NOOK_TRANSFORM_ROWS_3X4;
  pose_desc.transforms = pose;
  pose_desc.transform_count = info.bone_count;
  EXPECT_OK(nook_scene_set_pose(scene, a, &pose_desc));
  EXPECT_OK(nook_scene_link(scene, a, b));
  EXPECT_OK(nook_scene_unlink(scene, a, b));
  EXPECT_OK(nook_scene_link_nearest(scene, 4, 10.0f));
  EXPECT_OK(nook_scene_set_ground(scene, a, plane));
  EXPECT_OK(nook_scene_add_occluder(scene, &ball, &occluder));
  ball.radius = 0.6f;
  ball.receiver = a;
  EXPECT_OK(nook_scene_set_occluder(scene, occluder, &ball));
  EXPECT_OK(nook_scene_set_camera(scene, centre));
  EXPECT_OK(nook_scene_set_terms(scene, NOOK_TERM_SELF | NOOK_TERM_LINKS));
  EXPECT_OK(nook_scene_update(scene));
  EXPECT_OK(nook_scene_read(scene, a, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao, info.file_vertex_count, 0));
  EXPECT_OK(nook_scene_set_model(scene, a, model));
  EXPECT_OK(nook_scene_update(scene));
  EXPECT_OK(nook_scene_read(scene, a, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao, info.file_vertex_count, 0));
  byte = (unsigned char)(ao[3] * 255 + 0.5f);
  EXPECT_OK(nook_scene_read(scene, a, NOOK_CHANNEL_AO, NOOK_FORMAT_UNORM8, ao, info.file_vertex_count, 0));
  EXPECT(((unsigned char*)ao)[3] == byte);
  EXPECT_OK(nook_scene_set_light(scene, a, &lobe, 1));
  EXPECT_OK(nook_scene_update(scene));
  colour = (float*)malloc(3 * info.file_vertex_count * sizeof(float));
  EXPECT_OK(nook_scene_read(scene, a, NOOK_CHANNEL_DIRECTIONAL_AO, NOOK_FORMAT_FLOAT, colour,
                            info.file_vertex_count, 0));
  EXPECT(colour[0] >= 0 && colour[0] <= 1);
  free(colour);
  memset(&stats, 0, sizeof stats);
  stats.struct_size = sizeof stats;
  EXPECT_OK(nook_scene_describe(scene, &stats));
  EXPECT(stats.memory_bytes > 2 * info.instance_bytes);
  EXPECT(stats.instances == 2 && stats.instances_updated == 2 && stats.links == 2 && stats.evaluations > 0);
  EXPECT_OK(nook_scene_remove_occluder(scene, occluder));
  EXPECT_OK(nook_scene_remove_instance(scene, b));
  EXPECT(nook_scene_update(NULL) == NOOK_ERROR_INVALID_ARGUMENT);
  EXPECT(strncmp(nook_last_message(), "nook_scene_update: ", 19) == 0);
  nook_context_destroy(&context);
  nook_model_destroy(&model);
  nook_scene_destroy(&scene);
  EXPECT(!context && !model && !scene);
  EXPECT(blocks == 0);
  EXPECT(lines > 0 && jobs > 0);
  free(pose);
  free(ao);
  return failures;
}
