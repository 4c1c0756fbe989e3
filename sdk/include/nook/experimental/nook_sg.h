/* Calculations with spherical Gaussians (lobes) and spherical harmonics (SH) in plain arrays. The header also
 * declares alternative methods of probe fits, for comparisons.
 *
 * Pass at most NOOK_PROBE_MAX_FUNCTIONS lobes. The functions of this header do not allocate. */
#ifndef NOOK_SG_H
#define NOOK_SG_H

#include "../nook_probe.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Lobes ---- */

/* Evaluates the radiance of lobes from `count` unit directions.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_sg_radiance(const nook_lobe* lobes, uint32_t lobe_count, const float* directions,
                                      float* radiance, size_t count);

/* How the irradiance of a lobe is computed. */
enum {
  /* S. Hill's fitted function for the irradiance of a lobe. Its error is at most 1.6 % of the irradiance on a
   * surface that faces the lobe. The function is not defined below sharpness 3; there,
   * NOOK_PROBE_IRRADIANCE_BANDS is used instead. */
  NOOK_PROBE_IRRADIANCE_FITTED = 0,
  /* The clamped cosine is approximated by a lobe. This is cheaper, but the irradiance is never 0 for surfaces
   * that face away from the light. */
  NOOK_PROBE_IRRADIANCE_INNER_PRODUCT = 1,
  /* The clamped cosine is expanded in spherical harmonics up to band 4, as in nook_probe_irradiance. The
   * error is at most 0.2 % up to sharpness 6, and 1 % at 16; above 16, NOOK_PROBE_IRRADIANCE_FITTED is used
   * instead. */
  NOOK_PROBE_IRRADIANCE_BANDS = 2
};
typedef int32_t nook_probe_irradiance_form;

/* Evaluates the irradiance of lobes on `count` surfaces with the given unit normals.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_sg_irradiance(const nook_lobe* lobes, uint32_t lobe_count,
                                        nook_probe_irradiance_form form, const float* normals,
                                        float* irradiance, size_t count);

/* How the GGX lobe of a surface is approximated. */
enum {
  /* One spherical Gaussian (after Wang et al. 2009). */
  NOOK_PROBE_SPECULAR_ISOTROPIC = 0,
  /* Four spherical Gaussians, one around each of four visible microfacet normals (Heitz 2018). For grazing
   * views, or if alpha_x and alpha_y differ, together they form a stretched lobe. */
  NOOK_PROBE_SPECULAR_ANISOTROPIC = 1
};
typedef int32_t nook_probe_specular_form;

typedef struct nook_probe_surface {
  /* Unit vector. */
  float normal[3];
  /* Unit vector from the surface to the eye. */
  float view[3];
  /* Unit vector perpendicular to the normal. It is only read if alpha_x and alpha_y differ. */
  float tangent[3];
  /* The GGX width (roughness squared) along the tangent, in [0.001, 1]. */
  float alpha_x;
  /* The GGX width across the tangent. The isotropic form uses the geometric mean of alpha_x and alpha_y. */
  float alpha_y;
  /* The reflectance at normal incidence (Schlick), in [0, 1]. */
  float reflectance;
} nook_probe_surface;

/* Computes the radiance that GGX surfaces reflect to the eye, one colour for each surface. Use it to check
 * your shader. The model is single scattering with Schlick Fresnel and height-correlated Smith masking (Heitz
 * 2014). If the cosine between normal and view is 0.02 or more, expect these errors:
 *     5 %        under constant light, for a reflectance of 0.02 or more
 *     9 %        anisotropic form, under 12 lobes of sharpness 6 whose amplitudes differ by up to 1 : 9
 *     13 %       isotropic form, under the same lobes
 *     40 %       if one lobe is 20 times as bright as the others
 * If alpha_x and alpha_y differ, the error of the anisotropic form is at most 14 %; under constant light, it
 * is at most 5 % at reflectance 1, and 20 % at reflectance 0.04. docs/probes.md has more measurements.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_sg_specular(const nook_lobe* lobes, uint32_t lobe_count,
                                      nook_probe_specular_form form, const nook_probe_surface* surfaces,
                                      float* rgb, size_t count);

/* Writes the lobes for glossy reflection at a point. Pass them to nook_sg_specular. The lobes have the same
 * axes and sharpnesses as the lobes of nook_probe_read_lobes, but different amplitudes, which are never
 * negative. The lobes of nook_probe_read_lobes are good for irradiance, because they keep bands 0 to 2 of the
 * light. But between strong lights, their radiance is negative, and glossy surfaces would show black patches.
 * A probe has amplitudes for gloss if you created it from fits or loaded it from a baked file. `nook bake
 * probe` removes the suns from a map before the fit, so draw the suns as separate lights. `position_ws` and
 * `function_count` are as in nook_probe_read_lobes. The GLSL of an upload reads the same amplitudes. The call
 * does not allocate. Any thread. Errors: INVALID_ARGUMENT (also if the basis is not NOOK_PROBE_BASIS_LOBES),
 * UNSUPPORTED (the probe has no amplitudes for gloss). */
NOOK_API nook_result nook_probe_read_gloss(nook_probe probe, const float* position_ws, nook_lobe* lobes,
                                           uint32_t function_count);

/* Computes the integral of a lobe over the sphere, as RGB.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_sg_integral(const nook_lobe* lobe, float rgb[3]);

/* Computes the product of two lobes, which is exactly one lobe. Amplitudes are multiplied per channel. For
 * the integral of the product, pass the result to nook_sg_integral.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_sg_product(const nook_lobe* a, const nook_lobe* b, nook_lobe* out);

/* Computes a lobe around the axis of `a` that approximates the convolution of `a` with `b`. The lobe has the
 * same integral and the same mean cosine as the convolution.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_sg_convolve(const nook_lobe* a, const nook_lobe* b, nook_lobe* out);

/* Rotates the axes of lobes by a 3x3 matrix, row-major and orthonormal to 1e-3.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_sg_rotate(nook_lobe* lobes, uint32_t lobe_count, const float rotation[9]);

/* ---- Spherical harmonics: smaller than lobes for the same error of diffuse light ----
 *
 * A fit of NOOK_PROBE_BASIS_SH gives coefficients from samples (nook_probe_read_coefficients), and
 * nook_sg_to_sh gives them from lobes. shaders/probe/harmonics.glsl evaluates bands 0 to 2 (27 floats), and
 * ZH3 (15 floats). */

/* Projects lobes exactly onto real spherical harmonics of bands 0 to `order` (1 to 4). `coefficients`
 * receives (order + 1)^2 x RGB, band by band, and within band l from m = -l to l. The basis functions have no
 * Condon-Shortley phase; the first four are 0.282095 and 0.488603 times y, z and x.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_sg_to_sh(const nook_lobe* lobes, uint32_t lobe_count, uint32_t order,
                                   float* coefficients);

/* The value of `order` for the 5 x RGB coefficients of nook_sh_to_zh3. */
enum { NOOK_SH_ZH3 = 100 };

/* Evaluates the radiance from `count` unit directions, without approximation. `order` is 1 to 4, or
 * NOOK_SH_ZH3. The result is not clamped at 0, and can be negative opposite a sun.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_sh_radiance(const float* coefficients, uint32_t order, const float* directions,
                                      float* rgb, size_t count);

/* Evaluates the irradiance on `count` surfaces with the given unit normals, without approximation. `order` is
 * 1 to 4, or NOOK_SH_ZH3. The result is not clamped at 0. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_sh_irradiance(const float* coefficients, uint32_t order, const float* normals,
                                        float* rgb, size_t count);

/* Computes quadratic zonal harmonics, ZH3 (Roughton et al. 2024), from bands 0 to 2, 9 x RGB. The result is 5
 * x RGB: bands 0 and 1 unchanged, then one coefficient for band 2. This coefficient is the part of band 2
 * that is symmetric around the direction of band 1's luminance. You can interpolate and pack ZH3 in the same
 * way as other coefficients.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_sh_to_zh3(const float* coefficients, float* zonal);

/* ---- Fits for comparison ---- */

/* The value of nook_probe_info.basis for ambient dice (Iwanicki and Sloan 2017). The functions are
 * 0.35 c^2 + 0.25 c^4 with c = max(dot(v, s), 0), at the 12 vertices v of an icosahedron. */
enum { NOOK_PROBE_BASIS_DICE = 2 };

/* Methods that replace nook_probe_fit_desc.method. G_ik is the integral of B_i B_k. m_i is the integral of
 * B_i f, estimated from the samples. */
enum {
  /* The method of nook_probe_fit_desc. */
  NOOK_PROBE_FIT_STUDY_DEFAULT = 0,
  /* b_i = m_i / sum_k G_ik, or b_i = m_i / G_ii for harmonics. Constant light is exact, and other light is
   * blurred. match_sh has no effect. */
  NOOK_PROBE_FIT_STUDY_NAIVE = 1,
  /* The running average in its first published form, b_i += (1 / n) B_i (v - R) / mean of B_i. It converges
   * to the same result as the corrected form, but its steps are half as large, so it is much slower. Not
   * available for harmonics. match_sh has no effect. */
  NOOK_PROBE_FIT_STUDY_RUNNING_AVERAGE_ORIGINAL = 2,
  /* b = G^-1 m with the exact G. Merging fits is exact. */
  NOOK_PROBE_FIT_STUDY_MOMENTS = 3
};
typedef int32_t nook_probe_study_method;

/* How the divisor D_i of the published step is computed; see nook_probe_fit_study_desc.published_step. */
enum {
  /* The average over the same samples or the exact integral, whichever is larger. */
  NOOK_PROBE_DENOMINATOR_LOCKSTEP = 0,
  /* The exact integral. */
  NOOK_PROBE_DENOMINATOR_PRECOMPUTED = 1
};
typedef int32_t nook_probe_denominator;

/* Options of a fit for comparisons with papers. Point nook_probe_fit_desc.next to this struct. */
typedef struct nook_probe_fit_study_desc {
  uint32_t struct_size, type;
  const void* next;
  /* Default NOOK_PROBE_FIT_STUDY_DEFAULT. Another method replaces nook_probe_fit_desc.method; `method` and
   * `form` of nook_probe_fit_desc must then have their defaults. */
  nook_probe_study_method method;
  /* 1: running averages take the published step at each sample. The sample has the direction w and the
   * radiance v; a is the domain's area, and n is the sum of weights so far. The step is b_i += (1 / n)
   * (B_i(w) (v - sum over k != i of b_k B_k(w)) / D_i - b_i). D_i is an estimate of G_ii / a. The
   * non-negative form clamps after each sample. NOOK_FORM_PAPER always takes the published step. 0 (default):
   * running averages take one step per block of samples. It solves (n G / a + S) (b' - b) = m - S b for the
   * new coefficients b'. S and m are the block's sums of B_i B_k and B_i v, and n is the sum of weights
   * before the block. */
  int32_t published_step;
  /* Used only by the published step. Default NOOK_PROBE_DENOMINATOR_LOCKSTEP. */
  nook_probe_denominator denominator;
  /* 1: the basis functions are ambient dice, and nook_probe_fit_desc.basis and match_sh have no effect.
   * Default 0. */
  int32_t dice;
} nook_probe_fit_study_desc;
static inline nook_result nook_probe_fit_study_desc_init(nook_probe_fit_study_desc* desc) {
  return nook_desc_init(NOOK_DESC_PROBE_FIT_STUDY, desc, sizeof *desc, NOOK_VERSION);
}

/* Starts the running average `fit` from the coefficients of the fit `short_run` instead of 0. `fit` must not
 * have samples yet. In the average, these coefficients have the same weight as all samples of `short_run`
 * together. Both fits must have the same basis. Methods other than running averages ignore the call.
 * nook_probe_fit_reset removes the seed. No other thread may use the fits. One at a time. Errors:
 * INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_fit_seed(nook_probe_fit fit, nook_probe_fit short_run);

#ifdef __cplusplus
}
#endif
#endif
