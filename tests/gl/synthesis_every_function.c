/* Every function of nook_synthesis.h, called from C in the order a host would; returns the number of
 * failed expectations and prints each. The OpenGL context is current. */
#include <nook/experimental/nook_synthesis.h>
#include <nook/nook_gl.h>
#include <stdio.h>
#include <string.h>

int nook_synthesis_call_everything(const void* bytes, size_t size, nook_gl_proc_fn get_proc, void* user);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("synthesis_every_function.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)
#define EXPECT_OK(call) expect((call) == NOOK_OK, #call, __LINE__)

int nook_synthesis_call_everything(const void* bytes, size_t size, nook_gl_proc_fn get_proc, void* user) {
  nook_context_desc context_desc;
  nook_gl_desc gl_desc;
  nook_gl_upload_info uploaded;
  nook_context context = NULL;
  nook_gl gl = NULL;
  nook_synthesis synthesis = NULL;
  nook_gl_upload on_gpu = NULL;

  failures = 0;
  EXPECT_OK(nook_context_desc_init(&context_desc));
  EXPECT_OK(nook_context_create(&context_desc, &context));
  EXPECT_OK(nook_gl_desc_init(&gl_desc));
  gl_desc.get_proc = get_proc;
  gl_desc.get_proc_user = user;
  EXPECT_OK(nook_gl_create(context, &gl_desc, &gl));
  EXPECT(nook_gl_upload_synthesis(gl, NULL, &on_gpu) == NOOK_ERROR_INVALID_ARGUMENT);
  EXPECT_OK(nook_synthesis_load(context, bytes, size, &synthesis));
  EXPECT_OK(nook_gl_upload_synthesis(gl, synthesis, &on_gpu));
  nook_synthesis_destroy(&synthesis);
  memset(&uploaded, 0, sizeof uploaded);
  uploaded.struct_size = sizeof uploaded;
  EXPECT_OK(nook_gl_upload_describe(on_gpu, &uploaded));
  EXPECT(uploaded.textures[0].texture != 0 && uploaded.bytes == 8 * 8 * 4);
  EXPECT(strstr(uploaded.glsl, "nook_synthesis_material_uv") != NULL);
  nook_gl_destroy(&gl);
  nook_context_destroy(&context);
  nook_gl_upload_destroy(&on_gpu);
  EXPECT(!on_gpu);
  nook_gl_upload_destroy(&on_gpu);
  return failures;
}
