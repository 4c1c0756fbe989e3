/* Every function of nook_gl.h and of captures, called from C in the order a host would;
 * returns the number of failed expectations and prints each. The OpenGL context is current; bytes: a
 * character model. */
#include <nook/experimental/nook_capture.h>
#include <nook/experimental/nook_debug.h>
#include <nook/nook_gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int nook_gl_call_everything(const void* bytes, size_t size, nook_gl_proc_fn get_proc, void* user);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("every_function.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)
#define EXPECT_OK(call) expect((call) == NOOK_OK, #call, __LINE__)

static void read_ao(nook_gl gl, nook_scene scene, nook_instance_id instance, uint32_t count) {
  float* ao = (float*)malloc(count * sizeof(float));
  uint32_t i;
  for (i = 0; i < count; ++i) ao[i] = -1;
  EXPECT_OK(nook_gl_scene_read(gl, scene, instance, NOOK_CHANNEL_AO, ao, count));
  for (i = 0; i < count; ++i) EXPECT(ao[i] >= 0 && ao[i] <= 1);
  free(ao);
}

static void light_instance(nook_gl gl, nook_scene scene, nook_instance_id instance, uint32_t count) {
  const nook_lobe lobe = {{0, 1, 0}, 6, {1, 2, 3}, 0};
  float* rgb = (float*)malloc(3 * count * sizeof(float));
  nook_gl_view view;
  uint32_t i;
  memset(&view, 0, sizeof view);
  view.struct_size = sizeof view;
  EXPECT(nook_gl_scene_view(gl, scene, instance, NOOK_CHANNEL_DIRECTIONAL_AO, &view) ==
         NOOK_ERROR_INVALID_HANDLE);
  EXPECT(nook_gl_scene_read(gl, scene, instance, NOOK_CHANNEL_DIRECTIONAL_AO, rgb, count) ==
         NOOK_ERROR_INVALID_HANDLE);
  EXPECT_OK(nook_scene_set_light(scene, instance, &lobe, 1));
  EXPECT_OK(nook_gl_scene_update(gl, scene));
  EXPECT_OK(nook_gl_scene_view(gl, scene, instance, NOOK_CHANNEL_DIRECTIONAL_AO, &view));
  EXPECT(view.buffer != 0 && view.texture != 0 && view.stride == 3 * sizeof(float) && view.count == count);
  EXPECT(view.light >= 0 && strstr(view.glsl, "nook_scene_irradiance"));
  for (i = 0; i < 3 * count; ++i) rgb[i] = -1;
  EXPECT_OK(nook_gl_scene_read(gl, scene, instance, NOOK_CHANNEL_DIRECTIONAL_AO, rgb, count));
  for (i = 0; i < 3 * count; ++i) EXPECT(rgb[i] >= 0 && rgb[i] <= 1);
  free(rgb);
}

/* A capture without a map: no name is that of a cube map here. */
static void capture_probe(nook_gl gl, nook_gl_upload probe) {
  nook_gl_capture_desc desc;
  nook_gl_capture capture = NULL;
  nook_gl_capture_info result;
  nook_probe solved = NULL;
  EXPECT_OK(nook_gl_capture_desc_init(&desc));
  desc.probe = probe;
  EXPECT_OK(nook_gl_capture_create(gl, &desc, &capture));
  EXPECT(nook_gl_capture_add(capture, 0, 0, 0) == NOOK_ERROR_INVALID_ARGUMENT);
  memset(&result, 0, sizeof result);
  result.struct_size = sizeof result;
  EXPECT_OK(nook_gl_capture_read(capture, 0, &result));
  EXPECT(result.maps == 0);
  EXPECT_OK(nook_gl_capture_solve(capture, &solved));
  nook_probe_destroy(&solved);
  nook_gl_capture_destroy(&capture);
}

static void upload_probe(nook_context context, nook_gl gl) {
  const float coefficients[3 * 12] = {1};
  nook_probe_fit_desc fit_desc;
  nook_probe_desc probe_desc;
  nook_probe_fit fit = NULL;
  nook_probe probe = NULL;
  nook_gl_upload uploaded = NULL, clips = NULL;
  nook_gl_upload_info info;
  nook_gl_upload grid = NULL;
  nook_gl_upload_info grid_info;
  EXPECT_OK(nook_probe_fit_desc_init(&fit_desc));
  EXPECT_OK(nook_probe_fit_create(context, &fit_desc, &fit));
  EXPECT_OK(nook_probe_desc_init(&probe_desc));
  probe_desc.functions = fit;
  probe_desc.coefficients = coefficients;
  EXPECT_OK(nook_probe_create(context, &probe_desc, &probe));
  EXPECT_OK(nook_gl_upload_probe(gl, probe, NOOK_GL_PROBE_LOBES, &uploaded));
  EXPECT_OK(nook_gl_update_probe(uploaded, probe));
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  EXPECT_OK(nook_gl_upload_describe(uploaded, &info));
  /* OpenGL ES has 2D textures with whole rows. */
  EXPECT(info.textures[0].texture != 0 && info.bytes >= 16 * (3 + 12 * 2) &&
         strstr(info.glsl, "nook_probe_irradiance"));
  capture_probe(gl, uploaded);
  EXPECT(nook_gl_upload_clips(gl, NULL, &clips) == NOOK_ERROR_INVALID_ARGUMENT && clips == NULL);
  nook_gl_upload_destroy(&uploaded);
  EXPECT(!uploaded);
  EXPECT_OK(nook_gl_upload_probe(gl, probe, NOOK_GL_PROBE_ZH3, &grid));
  EXPECT_OK(nook_gl_update_probe(grid, probe));
  memset(&grid_info, 0, sizeof grid_info);
  grid_info.struct_size = sizeof grid_info;
  EXPECT_OK(nook_gl_upload_describe(grid, &grid_info));
  EXPECT(grid_info.textures[0].texture != 0 && grid_info.bytes == 4 * 8 &&
         strstr(grid_info.glsl, "nook_grid_irradiance"));
  nook_gl_upload_destroy(&grid);
  EXPECT(!grid);
  nook_probe_destroy(&probe);
  nook_probe_fit_destroy(&fit);
}

/* A target without a buffer and a texture is refused. */
static void write_ao(nook_gl gl, nook_scene scene, nook_instance_id instance) {
  nook_gl_ao_target target;
  memset(&target, 0, sizeof target);
  target.struct_size = sizeof target;
  EXPECT(nook_gl_scene_write(gl, scene, &instance, 1, &target) == NOOK_ERROR_INVALID_ARGUMENT);
}

int nook_gl_call_everything(const void* bytes, size_t size, nook_gl_proc_fn get_proc, void* user) {
  nook_context_desc context_desc;
  nook_scene_desc scene_desc;
  nook_gl_desc desc;
  nook_gl_info info;
  nook_gl_memory memory;
  nook_gl_view view;
  nook_context context = NULL;
  nook_model model = NULL;
  nook_scene scene = NULL;
  nook_instance_id instance = 0;
  nook_gl gl = NULL;

  failures = 0;
  EXPECT_OK(nook_context_desc_init(&context_desc));
  EXPECT_OK(nook_context_create(&context_desc, &context));
  EXPECT_OK(nook_model_load(context, bytes, size, &model));
  EXPECT_OK(nook_scene_desc_init(&scene_desc));
  EXPECT_OK(nook_scene_create(context, &scene_desc, &scene));
  EXPECT_OK(nook_scene_add_instance(scene, model, &instance));

  EXPECT_OK(nook_gl_desc_init(&desc));
  desc.get_proc = get_proc;
  desc.get_proc_user = user;
  EXPECT_OK(nook_gl_create(context, &desc, &gl));
  memset(&view, 0, sizeof view);
  view.struct_size = sizeof view;
  EXPECT(nook_gl_scene_view(gl, scene, instance, NOOK_CHANNEL_AO, &view) == NOOK_ERROR_INVALID_HANDLE);
  EXPECT_OK(nook_gl_scene_prepare(gl, scene));
  EXPECT_OK(nook_gl_scene_view(gl, scene, instance, NOOK_CHANNEL_AO, &view));
  EXPECT(view.buffer != 0 && view.stride == sizeof(float) && view.count > 0);
  EXPECT_OK(nook_gl_scene_update(gl, scene));
  read_ao(gl, scene, instance, view.count);
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  EXPECT_OK(nook_gl_describe(gl, &info));
  EXPECT(info.tier >= NOOK_GL_TIER_33 && info.version && info.renderer);
  memset(&memory, 0, sizeof memory);
  memory.struct_size = sizeof memory;
  EXPECT_OK(nook_gl_model_memory(gl, model, &memory));
  EXPECT(memory.model_bytes > 0 && memory.lit_instance_bytes > memory.instance_bytes);
  EXPECT(info.ao_bytes >= view.count * sizeof(float) && info.buffer_bytes > info.ao_bytes);
  write_ao(gl, scene, instance);
  light_instance(gl, scene, instance, view.count);
  upload_probe(context, gl);
  EXPECT_OK(nook_gl_scene_release(gl, scene));
  EXPECT(nook_gl_scene_view(gl, scene, instance, NOOK_CHANNEL_AO, &view) == NOOK_ERROR_INVALID_HANDLE);
  EXPECT_OK(nook_gl_describe(gl, &info));
  EXPECT(info.ao_bytes == 0);
  /* Everything is released, so that saying that the context is gone leaves nothing in OpenGL but programs. */
  EXPECT_OK(nook_gl_context_lost(gl));
  EXPECT(nook_gl_scene_update(gl, scene) == NOOK_ERROR_GL);
  EXPECT(strncmp(nook_last_message(), "nook_gl_scene_update: ", 22) == 0);
  nook_gl_destroy(&gl);
  nook_scene_destroy(&scene);
  nook_model_destroy(&model);
  nook_context_destroy(&context);
  EXPECT(!gl && !scene && !model && !context);
  return failures;
}
