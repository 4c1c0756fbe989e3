/* Every function of nook_transfer.h, called from C in the order a host would; returns the number of failed
 * expectations and prints each. The OpenGL context is current. */
#include <nook/experimental/nook_transfer.h>
#include <nook/nook_gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int nook_transfer_call_everything(const void* material_bytes, size_t material_size,
                                  const void* transfer_bytes, size_t transfer_size, nook_gl_proc_fn get_proc,
                                  void* user);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("transfer_every_function.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)
#define EXPECT_OK(call) expect((call) == NOOK_OK, #call, __LINE__)

enum { VERTICES = 3 };

int nook_transfer_call_everything(const void* material_bytes, size_t material_size,
                                  const void* transfer_bytes, size_t transfer_size, nook_gl_proc_fn get_proc,
                                  void* user) {
  nook_context_desc context_desc;
  nook_gl_desc gl_desc;
  nook_transfer_response_desc desc;
  nook_transfer_response_info info;
  nook_gl_upload_info uploaded;
  nook_context context = NULL;
  nook_gl gl = NULL;
  nook_material material = NULL;
  nook_transfer_response response = NULL;
  nook_transfer transfer = NULL;
  nook_gl_upload on_gpu = NULL, of_paper = NULL;
  float amplitudes[36] = {1, 2, 3};
  float* vectors;
  uint64_t count;

  failures = 0;
  EXPECT_OK(nook_context_desc_init(&context_desc));
  EXPECT_OK(nook_context_create(&context_desc, &context));
  EXPECT_OK(nook_gl_desc_init(&gl_desc));
  gl_desc.get_proc = get_proc;
  gl_desc.get_proc_user = user;
  EXPECT_OK(nook_gl_create(context, &gl_desc, &gl));
  EXPECT_OK(nook_material_load(context, material_bytes, material_size, NULL, &material));
  EXPECT_OK(nook_transfer_response_desc_init(&desc));
  desc.material = material;
  desc.lobe_count = 12;
  EXPECT_OK(nook_transfer_response_create(context, &desc, &response));
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  EXPECT_OK(nook_transfer_response_describe(response, &info));
  EXPECT_OK(nook_gl_upload_transfer(gl, NULL, response, VERTICES, &on_gpu));
  EXPECT_OK(nook_transfer_load(context, transfer_bytes, transfer_size, &transfer));
  EXPECT_OK(nook_gl_upload_transfer(gl, transfer, response, 0, &of_paper));
  nook_transfer_destroy(&transfer);
  nook_transfer_response_destroy(&response);
  nook_material_destroy(&material);
  EXPECT_OK(nook_gl_update_transfer(of_paper, amplitudes, 36));
  EXPECT(nook_gl_update_transfer(of_paper, amplitudes, 33) == NOOK_ERROR_INVALID_ARGUMENT);
  EXPECT(nook_gl_update_transfer(of_paper, NULL, 36) == NOOK_ERROR_INVALID_ARGUMENT);
  count = (uint64_t)VERTICES * info.vector_floats;
  vectors = calloc((size_t)count, sizeof *vectors);
  EXPECT_OK(nook_gl_update_transfer(on_gpu, vectors, count));
  EXPECT(nook_gl_update_transfer(on_gpu, vectors, count - 1) == NOOK_ERROR_INVALID_ARGUMENT);
  free(vectors);
  memset(&uploaded, 0, sizeof uploaded);
  uploaded.struct_size = sizeof uploaded;
  EXPECT_OK(nook_gl_upload_describe(on_gpu, &uploaded));
  EXPECT(uploaded.textures[0].texture != 0 && uploaded.bytes >= count * sizeof(float));
  EXPECT(strstr(uploaded.glsl, "nook_transfer_radiance") != NULL);
  EXPECT(uploaded.texture_count == 1);
  EXPECT_OK(nook_gl_upload_describe(of_paper, &uploaded));
  EXPECT(uploaded.texture_count == 2);
  EXPECT(strstr(uploaded.glsl, "nook_transfer_vertices") != NULL);
  nook_gl_destroy(&gl);
  nook_context_destroy(&context);
  nook_gl_upload_destroy(&on_gpu);
  nook_gl_upload_destroy(&of_paper);
  EXPECT(!on_gpu);
  return failures;
}
