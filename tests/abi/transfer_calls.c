/* Every function of the header of radiance transfer, called from C in the order a host would; returns the
 * number of failed expectations and prints each. */
#include <math.h>
#include <nook/experimental/nook_transfer.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int nook_call_every_transfer_function(const void* transfer_bytes, size_t transfer_size,
                                      const void* material_bytes, size_t material_size);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("transfer_calls.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)
#define EXPECT_OK(call) expect((call) == NOOK_OK, #call, __LINE__)

enum { WIDTH = 16, HEIGHT = 8, MOST_LOBES = 64, MOST_FLOATS = 4096 };

static void make_map(float* rgb) {
  int i;
  for (i = 0; i < WIDTH * HEIGHT; ++i) {
    rgb[3 * i] = i < WIDTH * HEIGHT / 2 ? 1.0f : 0.1f;
    rgb[3 * i + 1] = 0.5f;
    rgb[3 * i + 2] = i == WIDTH + 3 ? 4000.0f : 0.2f;
  }
}

static nook_probe make_probe(nook_context context) {
  nook_probe_fit_desc fit_desc;
  nook_probe_desc desc;
  nook_probe_fit fit = NULL;
  nook_probe probe = NULL;
  float coefficients[36];
  int i;
  for (i = 0; i < 36; ++i) coefficients[i] = 0.3f;
  EXPECT_OK(nook_probe_fit_desc_init(&fit_desc));
  EXPECT_OK(nook_probe_fit_create(context, &fit_desc, &fit));
  EXPECT_OK(nook_probe_desc_init(&desc));
  desc.functions = fit;
  desc.coefficients = coefficients;
  EXPECT_OK(nook_probe_create(context, &desc, &probe));
  nook_probe_fit_destroy(&fit);
  return probe;
}

static void light_vertices(nook_context context, nook_transfer transfer, nook_material material,
                           uint32_t lobes, uint32_t vertices) {
  static float vectors[MOST_FLOATS];
  static const float direction[3] = {0, 1, 0}, irradiance[3] = {2, 2, 2}, normal[3] = {0, 1, 0},
                     tangent[4] = {1, 0, 0, 1};
  static const float quarter_turn[9] = {0, 0, 1, 0, 1, 0, -1, 0, 0};
  float rgb[3 * WIDTH * HEIGHT], amplitudes[3 * MOST_LOBES], radiance[3];
  const nook_material_pixel pixel = {{0.2f, 0.7f}, {0, 0}, {0, 0}, {0, 0, 1}, {0, 0, 1}};
  nook_transfer_light_desc map, at_probe, from_side;
  nook_transfer_vectors_desc baked, open;
  nook_transfer_light light = NULL, of_probe = NULL, directional = NULL;
  nook_transfer_projection_info quality;
  nook_transfer_response_desc response_desc;
  nook_transfer_response response = NULL;
  nook_transfer_response_info info;
  nook_transfer_sun sun;
  nook_probe probe = make_probe(context);
  uint32_t suns = 0;
  memset(&quality, 0, sizeof quality);
  memset(&info, 0, sizeof info);
  quality.struct_size = sizeof quality;
  info.struct_size = sizeof info;
  make_map(rgb);
  EXPECT_OK(nook_transfer_light_desc_init(&map));
  map.rgb = rgb;
  map.width = WIDTH;
  map.height = HEIGHT;
  map.split_suns = 1;
  EXPECT_OK(nook_transfer_light_create(context, &map, &light));
  EXPECT_OK(nook_transfer_light_read_suns(light, NULL, &suns));
  EXPECT(suns == 1);
  EXPECT_OK(nook_transfer_light_read_suns(light, &sun, &suns));
  EXPECT(suns == 1 && sun.direction[1] > 0 && sun.irradiance[2] > sun.irradiance[0]);
  EXPECT_OK(nook_transfer_light_desc_init(&at_probe));
  at_probe.probe = probe;
  EXPECT_OK(nook_transfer_light_create(context, &at_probe, &of_probe));
  EXPECT_OK(nook_transfer_light_desc_init(&from_side));
  from_side.direction = direction;
  memcpy(from_side.irradiance, irradiance, sizeof irradiance);
  EXPECT_OK(nook_transfer_light_create(context, &from_side, &directional));
  EXPECT_OK(nook_transfer_light_project(of_probe, lobes, NULL, amplitudes, NULL));
  EXPECT_OK(nook_transfer_light_project(directional, lobes, NULL, amplitudes, NULL));
  EXPECT_OK(nook_transfer_light_project(light, lobes, quarter_turn, amplitudes, &quality));
  /* 19 lobes are blurred. */
  EXPECT(quality.relative_error > 0 && quality.relative_error < 1 && quality.negative_share < 0.5f);

  EXPECT_OK(nook_transfer_response_desc_init(&response_desc));
  response_desc.material = material;
  response_desc.lobe_count = lobes;
  EXPECT_OK(nook_transfer_response_create(context, &response_desc, &response));
  EXPECT_OK(nook_transfer_response_describe(response, &info));
  EXPECT(info.vector_floats == 3 * info.light_modes && info.vector_floats * vertices <= MOST_FLOATS);
  EXPECT_OK(nook_transfer_vectors_desc_init(&baked));
  baked.transfer = transfer;
  baked.amplitudes = amplitudes;
  baked.lobe_count = lobes;
  EXPECT_OK(nook_transfer_read_vectors(response, &baked, vectors, vertices, 0));
  EXPECT_OK(nook_transfer_vectors_desc_init(&open));
  open.amplitudes = amplitudes;
  open.lobe_count = lobes;
  open.normals = normal;
  open.tangents = tangent;
  EXPECT_OK(nook_transfer_read_vectors(response, &open, vectors, 1, 0));
  EXPECT_OK(nook_transfer_shade(material, &pixel, vectors, info.vector_floats, 1, radiance));
  EXPECT(isfinite(radiance[0] + radiance[1] + radiance[2]));
  nook_transfer_response_destroy(&response);
  nook_transfer_light_destroy(&light);
  nook_transfer_light_destroy(&directional);
  nook_transfer_light_destroy(&of_probe);
  nook_probe_destroy(&probe);
  EXPECT(!response && !light);
}

int nook_call_every_transfer_function(const void* transfer_bytes, size_t transfer_size,
                                      const void* material_bytes, size_t material_size) {
  nook_context_desc context_desc;
  nook_context context = NULL;
  nook_transfer transfer = NULL;
  nook_material material = NULL;
  nook_transfer_info info;
  nook_transfer_mesh_desc mesh;
  float* numbers;
  failures = 0;
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  EXPECT_OK(nook_context_desc_init(&context_desc));
  EXPECT_OK(nook_context_create(&context_desc, &context));
  EXPECT_OK(nook_transfer_load(context, transfer_bytes, transfer_size, &transfer));
  EXPECT_OK(nook_material_load(context, material_bytes, material_size, NULL, &material));
  EXPECT_OK(nook_transfer_describe(transfer, &info));
  EXPECT(info.lobe_count <= MOST_LOBES && info.share_bytes == (uint64_t)info.lobe_count * info.vertex_count);
  numbers = malloc(7 * (size_t)info.vertex_count * sizeof *numbers);
  EXPECT_OK(nook_transfer_read_frames(transfer, numbers, numbers + 3 * info.vertex_count, info.vertex_count));
  EXPECT_OK(nook_transfer_mesh_desc_init(&mesh));
  mesh.vertex_count = info.vertex_count;
  EXPECT_OK(nook_transfer_check(transfer, &mesh, NULL));
  mesh.positions = numbers;
  EXPECT(nook_transfer_check(transfer, &mesh, NULL) == NOOK_ERROR_INVALID_ARGUMENT);
  EXPECT(strstr(nook_last_message(), "positions") != NULL);
  EXPECT_OK(nook_transfer_check(transfer, NULL, material));
  light_vertices(context, transfer, material, info.lobe_count, info.vertex_count);
  free(numbers);
  nook_material_destroy(&material);
  nook_transfer_destroy(&transfer);
  nook_context_destroy(&context);
  EXPECT(!transfer);
  return failures;
}
