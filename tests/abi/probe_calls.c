/* Every function of the probes' header, called from C in the order a host would; returns the number of failed
 * expectations and prints each. */
#include <math.h>
#include <nook/experimental/nook_sg.h>
#include <nook/nook_probe.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int nook_call_every_probe_function(void);

static int failures;
static void expect(int condition, const char* what, int line) {
  if (condition) return;
  ++failures;
  printf("probe_calls.c:%d: %s: %s\n", line, what, nook_last_message());
}
#define EXPECT(condition) expect((condition), #condition, __LINE__)
#define EXPECT_OK(call) expect((call) == NOOK_OK, #call, __LINE__)

enum { SAMPLES = 2000 };

/* A sky, brighter above, from directions on a spiral, in an order that leaps about on it as random samples
 * would. */
static void make_samples(float* directions, float* radiance) {
  int i;
  for (i = 0; i < SAMPLES; ++i) {
    const float at = (float)(i * 773 % SAMPLES) + 0.5f;
    const float z = 1.0f - 2.0f * at / SAMPLES, r = sqrtf(1.0f - z * z);
    directions[3 * i] = r * cosf(2.399963f * at);
    directions[3 * i + 1] = r * sinf(2.399963f * at);
    directions[3 * i + 2] = z;
    radiance[3 * i] = radiance[3 * i + 1] = radiance[3 * i + 2] = 1.0f + z;
  }
}

static void use_lobes(nook_lobe* lobes, uint32_t count) {
  const float up[3] = {0, 0, 1}, turn[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  float rgb[3] = {0, 0, 0}, harmonics[27], zonal[15], x;
  nook_lobe out;
  nook_probe_surface surface;
  EXPECT_OK(nook_sg_radiance(lobes, count, up, rgb, 1));
  EXPECT(rgb[0] > 1.5f && rgb[0] < 2.5f);
  EXPECT_OK(nook_sg_irradiance(lobes, count, NOOK_PROBE_IRRADIANCE_BANDS, up, rgb, 1));
  /* The integral of (1 + z) z over the upper hemisphere, pi + 2 pi / 3. */
  EXPECT(fabsf(rgb[0] - 5.236f) < 0.06f);
  memset(&surface, 0, sizeof surface);
  surface.normal[2] = surface.view[2] = surface.tangent[0] = 1;
  surface.alpha_x = surface.alpha_y = 0.1f;
  surface.reflectance = 1;
  EXPECT_OK(nook_sg_specular(lobes, count, NOOK_PROBE_SPECULAR_ANISOTROPIC, &surface, rgb, 1));
  EXPECT(rgb[0] > 1.4f && rgb[0] < 2.4f); /* a mirror of the light above */
  EXPECT_OK(nook_sg_integral(&lobes[0], rgb));
  EXPECT_OK(nook_sg_product(&lobes[0], &lobes[1], &out));
  EXPECT(out.sharpness > 0);
  EXPECT_OK(nook_sg_integral(&out, rgb));
  EXPECT_OK(nook_sg_convolve(&lobes[0], &lobes[1], &out));
  EXPECT(out.sharpness < lobes[0].sharpness);
  EXPECT_OK(nook_sg_to_sh(lobes, count, 2, harmonics));
  EXPECT(fabsf(harmonics[0] * 0.282095f - 1.0f) < 0.02f); /* the mean radiance */
  EXPECT_OK(nook_sh_radiance(harmonics, 2, up, rgb, 1));
  EXPECT(rgb[0] > 1.5f && rgb[0] < 2.5f);
  EXPECT_OK(nook_sh_irradiance(harmonics, 2, up, rgb, 1));
  EXPECT(fabsf(rgb[0] - 5.236f) < 0.06f);
  EXPECT_OK(nook_sh_to_zh3(harmonics, zonal));
  EXPECT_OK(nook_sh_radiance(zonal, NOOK_SH_ZH3, up, rgb, 1));
  EXPECT(rgb[0] > 1.5f && rgb[0] < 2.5f);
  EXPECT_OK(nook_sh_irradiance(zonal, NOOK_SH_ZH3, up, rgb, 1));
  EXPECT(fabsf(rgb[0] - 5.236f) < 0.06f);
  x = lobes[0].axis[0];
  EXPECT_OK(nook_sg_rotate(lobes, count, turn));
  EXPECT(fabsf(lobes[0].axis[1] - x) < 1e-6f);
}

static void use_probe(nook_context context, nook_probe probe) {
  const float up[3] = {0, 0, 1}, where[3] = {0, 0, 0};
  float rgb[3], coefficients[12 * 3];
  size_t size = 0;
  void* bytes;
  nook_probe again = NULL;
  nook_probe_info info;
  nook_lobe lobes[12];
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  EXPECT_OK(nook_probe_describe(probe, &info));
  EXPECT(info.function_count == 12 && info.probe_count == 1 && info.basis == NOOK_PROBE_BASIS_LOBES);
  EXPECT_OK(nook_probe_save(probe, NOOK_PROBE_PACKING_HALF, NULL, &size));
  bytes = malloc(size);
  EXPECT_OK(nook_probe_save(probe, NOOK_PROBE_PACKING_HALF, bytes, &size));
  EXPECT_OK(nook_probe_load(context, bytes, size, &again));
  free(bytes);
  EXPECT_OK(nook_probe_read_coefficients(again, 0, coefficients, 12));
  EXPECT_OK(nook_probe_radiance(again, where, up, rgb, 1));
  EXPECT(rgb[0] > 1.5f && rgb[0] < 2.5f);
  EXPECT_OK(nook_probe_irradiance(again, NULL, up, rgb, 1));
  EXPECT(fabsf(rgb[0] - 5.236f) < 0.06f);
  EXPECT_OK(nook_probe_irradiance(again, up, up, rgb, 1));
  EXPECT_OK(nook_probe_read_lobes(again, NULL, lobes, 12));
  EXPECT(lobes[3].amplitude[1] == coefficients[3 * 3 + 1]);
  use_lobes(lobes, 12);
  nook_probe_destroy(&again);
}

int nook_call_every_probe_function(void) {
  static float directions[3 * SAMPLES], radiance[3 * SAMPLES];
  nook_context_desc context_desc;
  nook_context context = NULL;
  nook_probe_fit_desc fit_desc;
  nook_probe_fit_study_desc study;
  nook_probe_fit fit = NULL, second = NULL;
  nook_probe_fit_info info;
  nook_probe_desc desc;
  nook_probe probe = NULL, made = NULL;

  failures = 0;
  make_samples(directions, radiance);
  EXPECT_OK(nook_context_desc_init(&context_desc));
  EXPECT_OK(nook_context_create(&context_desc, &context));
  EXPECT_OK(nook_probe_fit_desc_init(&fit_desc));
  EXPECT_OK(nook_probe_fit_create(context, &fit_desc, &fit));
  EXPECT_OK(nook_probe_fit_study_desc_init(&study));
  fit_desc.next = &study;
  EXPECT_OK(nook_probe_fit_create(context, &fit_desc, &second));
  EXPECT_OK(nook_probe_fit_add_samples(fit, directions, radiance, NULL, SAMPLES));
  EXPECT_OK(nook_probe_fit_seed(second, fit));
  EXPECT_OK(nook_probe_fit_merge(fit, second));
  EXPECT_OK(nook_probe_fit_reset(second));
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  EXPECT_OK(nook_probe_fit_describe(fit, &info));
  EXPECT(info.samples == SAMPLES && info.skipped == 0 && fabs(info.mean_radiance[0] - 1) < 1e-3);
  EXPECT_OK(nook_probe_fit_solve(fit, &probe));
  EXPECT_OK(nook_probe_desc_init(&desc));
  desc.fits = &fit;
  desc.fit_count = 1;
  EXPECT_OK(nook_probe_create(context, &desc, &made));
  nook_probe_fit_destroy(&fit);
  nook_probe_fit_destroy(&second);
  use_probe(context, probe);
  use_probe(context, made);
  nook_context_destroy(&context);
  nook_probe_destroy(&probe);
  nook_probe_destroy(&made);
  EXPECT(!fit && !second && !probe && !made && !context);
  return failures;
}
