/* Every function of nook_material.h and nook_gl.h, called from C in the order a host would; returns
 * the number of failed expectations and prints each. The OpenGL context is current; bytes: a material with a
 * VOTF. */
#include <nook/nook_gl.h>
#include <stdio.h>
#include <string.h>

int nook_material_call_everything(const void* bytes, size_t size, nook_gl_proc_fn get_proc, void* user);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("material_every_function.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)
#define EXPECT_OK(call) expect((call) == NOOK_OK, #call, __LINE__)

int nook_material_call_everything(const void* bytes, size_t size, nook_gl_proc_fn get_proc, void* user) {
  nook_context_desc context_desc;
  nook_gl_desc gl_desc;
  nook_gl_upload_info uploaded;
  nook_material_info info;
  nook_material_value value;
  const nook_material_pixel pixel = {{0.5F, 0.5F}, {0.1F, 0}, {0, 0.2F}, {0, 0, 1}, {0, 0, 1}};
  nook_context context = NULL;
  nook_gl gl = NULL;
  nook_material_desc material_desc;
  nook_material material = NULL;
  nook_gl_upload on_gpu = NULL;
  uint32_t i;

  failures = 0;
  EXPECT_OK(nook_context_desc_init(&context_desc));
  EXPECT_OK(nook_context_create(&context_desc, &context));
  EXPECT_OK(nook_gl_desc_init(&gl_desc));
  gl_desc.get_proc = get_proc;
  gl_desc.get_proc_user = user;
  EXPECT_OK(nook_gl_create(context, &gl_desc, &gl));

  EXPECT_OK(nook_material_desc_init(&material_desc));
  EXPECT(material_desc.blocks == NOOK_MATERIAL_BLOCKS_NONE && material_desc.whole_light_modes == 4);
  EXPECT_OK(nook_material_load(context, bytes, size, &material_desc, &material));
  nook_material_destroy(&material);
  EXPECT_OK(nook_material_load(context, bytes, size, NULL, &material));
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  EXPECT_OK(nook_material_describe(material, &info));
  EXPECT(info.visibility != NOOK_MATERIAL_VISIBILITY_NONE && info.btf.terms > 0 && info.votf.terms > 0);
  EXPECT(info.decode_fetches > 0 && info.light_fetches > 0 && info.occlusion_fetches > 0);
  EXPECT(info.further_decode_fetches > 0 && info.further_occlusion_fetches > 0);
  EXPECT_OK(nook_material_evaluate(material, &pixel, 1, NOOK_MATERIAL_MAX_FETCHES, &value));
  EXPECT(value.visibility >= 0 && value.visibility <= 1);

  EXPECT_OK(nook_gl_upload_material(gl, material, &on_gpu));
  nook_material_destroy(&material);
  memset(&uploaded, 0, sizeof uploaded);
  uploaded.struct_size = sizeof uploaded;
  EXPECT_OK(nook_gl_upload_describe(on_gpu, &uploaded));
  EXPECT(uploaded.bytes == info.table_bytes && strstr(uploaded.glsl, "nook_material_decode"));
  EXPECT(uploaded.texture_count > 0);
  for (i = 0; i < uploaded.texture_count; ++i)
    EXPECT(uploaded.textures[i].texture != 0 && strstr(uploaded.glsl, uploaded.textures[i].uniform));
  EXPECT(nook_gl_upload_bind(on_gpu, 0, 0) == NOOK_ERROR_INVALID_ARGUMENT);
  nook_gl_upload_destroy(&on_gpu);
  nook_gl_destroy(&gl);
  nook_context_destroy(&context);
  EXPECT(!material && !on_gpu && !gl && !context);
  return failures;
}
