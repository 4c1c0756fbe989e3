/* Every function of the header of coordinate textures, called from C in the order a host would; returns the
 * number of failed expectations and prints each. */
#include <nook/experimental/nook_synthesis.h>
#include <stdio.h>
#include <string.h>

int nook_call_every_synthesis_function(const void* synthesis_bytes, size_t synthesis_size,
                                       const void* material_bytes, size_t material_size);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("synthesis_calls.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)
#define EXPECT_OK(call) expect((call) == NOOK_OK, #call, __LINE__)

int nook_call_every_synthesis_function(const void* synthesis_bytes, size_t synthesis_size,
                                       const void* material_bytes, size_t material_size) {
  static const float plane[4] = {0.25f, 0.5f, -3.5f, 100.0f};
  float uvs[4];
  nook_context_desc context_desc;
  nook_context context = NULL;
  nook_material material = NULL;
  nook_synthesis synthesis = NULL;
  nook_synthesis_info info;
  nook_material_info worn;
  int i;
  failures = 0;
  EXPECT_OK(nook_context_desc_init(&context_desc));
  EXPECT_OK(nook_context_create(&context_desc, &context));
  EXPECT_OK(nook_material_load(context, material_bytes, material_size, NULL, &material));
  EXPECT_OK(nook_synthesis_load(context, synthesis_bytes, synthesis_size, &synthesis));
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  EXPECT_OK(nook_synthesis_describe(synthesis, &info));
  EXPECT(info.side == 8 && info.texture_bytes == 8 * 8 * 4);
  memset(&worn, 0, sizeof worn);
  worn.struct_size = sizeof worn;
  EXPECT_OK(nook_material_describe(material, &worn));
  EXPECT(info.material_width == worn.width && info.material_height == worn.height);
  EXPECT_OK(nook_synthesis_material_uvs(synthesis, plane, 2, uvs));
  for (i = 0; i < 4; ++i) EXPECT(uvs[i] >= 0 && uvs[i] <= 1);
  nook_synthesis_destroy(&synthesis);
  EXPECT(nook_synthesis_load(context, material_bytes, material_size, &synthesis) == NOOK_ERROR_BAD_FILE);
  EXPECT(!synthesis);
  EXPECT_OK(nook_synthesis_load(context, synthesis_bytes, synthesis_size, &synthesis));
  nook_synthesis_destroy(&synthesis);
  EXPECT(!synthesis);
  nook_synthesis_destroy(&synthesis);
  nook_material_destroy(&material);
  nook_context_destroy(&context);
  return failures;
}
