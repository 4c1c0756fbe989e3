/* Light probes. A probe stores the radiance that arrives at a point from all directions, as a sum of a few
 * basis functions. Fit a probe to samples of radiance, or load it from a file; then read radiance, irradiance
 * and lobes from it. Multiply a probe's light by AO. In your integrator:
 *     nook_probe_fit_add_samples(fit, directions, radiance, NULL, count);      as often as you have samples
 *     nook_probe_fit_solve(fit, &probe);                                       at any time
 * Directions are unit vectors that point away from the probe. Radiance is linear RGB in any unit, and
 * irradiance is in your unit times steradians; a Lambertian surface reflects albedo / pi * irradiance * AO.
 * Arrays of directions and colours hold three floats for each entry, without padding. A probe stores R(s),
 * the sum of b_i B_i(s) over i; b_i is the RGB coefficient of the function B_i. For spherical Gaussians,
 * called lobes, B_i(s) = exp(sharpness_i (dot(axis_i, s) - 1)), and b_i is the amplitude. An ambient term is
 * a lobe of sharpness 0. A fit minimises the integral of (R - f)^2 over its domain, where f is the radiance
 * (T. Roughton, progressive least squares, 2018). docs/probes.md has the equations, and
 * experimental/nook_sg.h has functions for the arithmetic of lobes and spherical harmonics. */
#ifndef NOOK_PROBE_H
#define NOOK_PROBE_H

#include "nook.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The basis functions of a probe. */
enum {
  /* Lobes, and an ambient term if you set nook_probe_fit_desc.ambient; 3 floats for each. */
  NOOK_PROBE_BASIS_LOBES = 0,
  /* Real spherical harmonics (SH) of bands 0 to `order`, orthonormal over the sphere. */
  NOOK_PROBE_BASIS_SH = 1
};
typedef int32_t nook_probe_basis;

/* The directions over which a probe is fitted. */
enum {
  NOOK_PROBE_DOMAIN_SPHERE = 0,
  /* The directions within 90 degrees of an axis, for lightmaps. A fit skips samples from other directions. */
  NOOK_PROBE_DOMAIN_HEMISPHERE = 1
};
typedef int32_t nook_probe_domain;

/* ---- Fits ---- */

/* The method of a fit. NON_NEGATIVE methods keep all coefficients >= 0. Use them for small bright sources,
 * where an unconstrained fit has negative ringing. They need NOOK_PROBE_BASIS_LOBES. */
enum {
  /* The most accurate method for any number of samples. Merging fits is exact. */
  NOOK_PROBE_FIT_LEAST_SQUARES = 0,
  /* Least squares without negative coefficients. Merging fits is exact. */
  NOOK_PROBE_FIT_LEAST_SQUARES_NON_NEGATIVE = 1,
  /* Recursive least squares in blocks of 1,024 samples; you can solve after every sample. The error converges
   * to the error of LEAST_SQUARES. */
  NOOK_PROBE_FIT_RUNNING_AVERAGE = 2,
  /* A running average without negative coefficients: the non-negative solution nearest to RUNNING_AVERAGE. */
  NOOK_PROBE_FIT_RUNNING_AVERAGE_NON_NEGATIVE = 3
};
typedef int32_t nook_probe_method;

typedef struct nook_probe_fit_desc {
  uint32_t struct_size, type;
  /* NULL (default), or a nook_probe_fit_study_desc of nook/experimental/nook_sg.h. */
  const void* next;
  /* Default NOOK_PROBE_FIT_LEAST_SQUARES. */
  nook_probe_method method;
  /* Default NOOK_FORM_DEFAULT. NOOK_FORM_PAPER is the published method, corrected: a running average with the
   * step 1 / n after each sample, without match_sh. Leave `method` and `match_sh` at their defaults then. */
  nook_form form;
  /* Only for lobes. 1 (default): the fit matches the light's spherical harmonics of bands 0 to 2, which make
   * up 99 % of the light's irradiance. The total light is then exact, and the irradiance error falls to about
   * a third. With fewer than 9 lobes, non-negative methods or a hemisphere, the match is approximate. 0:
   * plain least squares, for lobes so sharp that there are gaps between them. */
  int32_t match_sh;
  /* Default NOOK_PROBE_BASIS_LOBES. */
  nook_probe_basis basis;
  /* Default NOOK_PROBE_DOMAIN_SPHERE. */
  nook_probe_domain domain;
  /* The axis of the hemisphere, of unit length to 1e-3. Default (0, 0, 1), the normal of a tangent space. */
  float up[3];
  /* The number of lobes without the ambient term; 1 to 64, or 63 with the ambient term. Default 12. */
  uint32_t lobe_count;
  /* One sharpness for all lobes, 0 to 10000, used if `sharpnesses` is NULL. With 0 (default), Nook chooses it
   * so that neighbouring lobes overlap equally for any lobe_count; 6 for 12 lobes on the sphere. */
  float sharpness;
  /* lobe_count unit directions (to 1e-3), which the call copies. NULL (default): a Vogel spiral. */
  const float* axes;
  /* lobe_count values above 0, up to 10000, which the call copies. NULL (default): `sharpness` for all. */
  const float* sharpnesses;
  /* 1: the basis has an ambient (constant) term after the lobes. Default 0. */
  int32_t ambient;
  /* For spherical harmonics: the highest band, 1 to 4; default 2. */
  uint32_t order;
  /* A number of samples, >= 0. If 0 (default), weights are used as given. Otherwise, the weight of sample k,
   * counted from 1, is multiplied by 1 - exp(-k / growing_samples). Set it if the first samples are noisy. */
  float growing_samples;
  uint32_t reserved;
} nook_probe_fit_desc;
static inline nook_result nook_probe_fit_desc_init(nook_probe_fit_desc* desc) {
  return nook_desc_init(NOOK_DESC_PROBE_FIT, desc, sizeof *desc, NOOK_VERSION);
}

/* Creates a fit without samples. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (also if `method` or `match_sh` is set with NOOK_FORM_PAPER, or if two
 * functions are too similar for a fit to separate; the message names both), OUT_OF_MEMORY. */
NOOK_API nook_result nook_probe_fit_create(nook_context context, const nook_probe_fit_desc* desc,
                                           nook_probe_fit* out);

/* Destroys the fit and sets *fit to NULL. One at a time. */
NOOK_API void nook_probe_fit_destroy(nook_probe_fit* fit);

/* Adds samples of radiance. Pass `weights` NULL if directions are distributed uniformly; each then has the
 * weight 1. Otherwise, a direction drawn with probability density p over a domain of area a has the weight 1
 * / (a p), so that the mean of all weights is 1. If the mean is not 1, running averages converge more slowly.
 * The fit skips and counts a sample whose direction is not of unit length to 1e-3 or lies outside the
 * hemisphere. It also skips negative weights, values that are not finite, and values above 1e18. Running
 * averages need a random order. The call does not allocate. One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_fit_add_samples(nook_probe_fit fit, const float* directions,
                                                const float* radiance, const float* weights, size_t count);

/* Adds the samples of the fit `other`, such as one from another thread, to `fit`. The descriptors of both
 * fits must be equal. With least squares, the result is the same as one fit of all samples, up to rounding.
 * With running averages, the result is the mean of both solutions, weighted by the fits' total sample
 * weights. `other` is not changed. No other thread may use the fits. One at a time. Errors:
 * INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_fit_merge(nook_probe_fit fit, nook_probe_fit other);

/* Removes all samples. One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_fit_reset(nook_probe_fit fit);

/* Creates a probe from the samples so far; without samples, the probe is black. You may add more samples and
 * solve again. For a grid, fit each probe and pass all fits to nook_probe_create. On failure *out is NULL.
 * One at a time. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_probe_fit_solve(nook_probe_fit fit, nook_probe* out);

typedef struct nook_probe_fit_info {
  uint32_t struct_size;
  /* The number of functions: lobes and the ambient term, or harmonics; 12 for ambient dice. */
  uint32_t function_count;
  /* The numbers of samples that the fit used and skipped. `skipped` is the sum of the next three counts. */
  uint64_t samples, skipped;
  /* The fit skipped this many samples because of their direction (not finite, not of unit length or outside
   * the hemisphere), their radiance (not finite), and their weight (negative or not finite). */
  uint64_t skipped_direction, skipped_radiance, skipped_weight;
  /* The sum of the weights of the used samples. */
  double weight;
  /* The weighted mean of the used samples. The mean radiance of a good fit is close to this value. */
  double mean_radiance[3];
} nook_probe_fit_info;

/* Describes a fit and counts its samples. One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_fit_describe(nook_probe_fit fit, nook_probe_fit_info* info);

/* ---- Probes: one, or a grid with the same functions; immutable, usable on several threads ---- */

/* For a grid, set `counts`, `origin_ws` and `spacing_ws`. Set one of three sources of light: `fits`, `lobes`,
 * or `functions` with `coefficients`. In arrays with an entry for each probe, x varies fastest, then y, then
 * z. The call copies all arrays. You may destroy the fits afterwards. */
typedef struct nook_probe_desc {
  uint32_t struct_size, type;
  const void* next;
  /* The numbers of probes along x, y and z; their product is at most 1,048,576. Default 1, 1, 1. */
  uint32_t counts[3];
  /* The position of the first probe in metres; default 0. */
  float origin_ws[3];
  /* The distances between neighbours along x, y and z in metres, > 0; default 1. */
  float spacing_ws[3];
  /* The number of fits: one for each probe. Default 0. */
  uint32_t fit_count;
  /* Fits with the same basis and domain, or NULL (default). The call solves each fit. */
  const nook_probe_fit* fits;
  /* lobe_count lobes for each probe, or NULL (default). All probes must have the same axes and sharpnesses.
   * Only the last lobe may have the sharpness 0; it is the ambient term. */
  const nook_lobe* lobes;
  /* The number of lobes of each probe, 1 to 64. Default 0. */
  uint32_t lobe_count;
  uint32_t reserved;
  /* A fit that defines the coefficients' basis and domain, or NULL (default). Its samples are not used. */
  nook_probe_fit functions;
  /* function_count x RGB for each probe, or NULL (default). */
  const float* coefficients;
} nook_probe_desc;
static inline nook_result nook_probe_desc_init(nook_probe_desc* desc) {
  return nook_desc_init(NOOK_DESC_PROBE, desc, sizeof *desc, NOOK_VERSION);
}

/* Creates a probe or a grid. On failure *out is NULL. No other thread may use the fits during the call. Any
 * thread. Errors: INVALID_ARGUMENT (also if not exactly one source is set, if the fits have different
 * functions, or if a coefficient is not finite or its magnitude is above 1e22), OUT_OF_MEMORY. */
NOOK_API nook_result nook_probe_create(nook_context context, const nook_probe_desc* desc, nook_probe* out);

/* Loads a probe or a grid from the bytes of a .nook file, which you may free afterwards. The library
 * validates all bytes, so you can load files that you do not trust. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_probe_load(nook_context context, const void* bytes, size_t size, nook_probe* out);

/* Releases your reference and sets *probe to NULL. Any thread. */
NOOK_API void nook_probe_destroy(nook_probe* probe);

/* The storage of an RGB coefficient in a file. */
enum {
  /* 12 bytes, exact. */
  NOOK_PROBE_PACKING_FLOAT = 0,
  /* 6 bytes. The relative error of a channel is at most 2^-11 for values from 6.1e-5 to 65504; for smaller
   * values, the absolute error is at most 3e-8. Larger values fail with INVALID_ARGUMENT. */
  NOOK_PROBE_PACKING_HALF = 1,
  /* 4 bytes. The error is at most 2^-9 of the largest of the three channels, if that is 3.1e-5 to 65408.
   * Negative channels and larger values fail with INVALID_ARGUMENT. */
  NOOK_PROBE_PACKING_RGB9E5 = 2
};
typedef int32_t nook_probe_packing;

/* Writes the .nook file of a probe to `bytes`. Set *size to the buffer's size; the call sets it to the file's
 * size. With `bytes` NULL, it only sets *size. The call allocates from the C++ heap. Any thread. Errors:
 * INVALID_ARGUMENT (also if the buffer is too small; *size is then the required size), OUT_OF_MEMORY. */
NOOK_API nook_result nook_probe_save(nook_probe probe, nook_probe_packing packing, void* bytes, size_t* size);

typedef struct nook_probe_info {
  uint32_t struct_size;
  nook_probe_basis basis;
  nook_probe_domain domain;
  /* The axis of the hemisphere. */
  float up[3];
  uint32_t function_count;
  /* 1: the last function is a constant term, a lobe of sharpness 0. */
  int32_t ambient;
  /* The highest band of harmonics; 0 for other bases. */
  uint32_t order;
  /* The grid has this many probes in all, and along x, y and z. */
  uint32_t probe_count, counts[3];
  /* The position of the first probe in metres. */
  float origin_ws[3];
  /* The distances between neighbours along x, y and z in metres. */
  float spacing_ws[3];
  /* The number of cells of the grid that contain walls; 0: the grid has no walls. */
  uint32_t wall_cells;
} nook_probe_info;

/* Describes a probe. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_describe(nook_probe probe, nook_probe_info* info);

/* Writes the coefficients of one probe: function_count x RGB. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_read_coefficients(nook_probe probe, uint32_t index, float* coefficients,
                                                  uint32_t function_count);

/* Writes the lobes at a point (world space, metres). A grid is interpolated trilinearly; a point outside gets
 * the lobes at the grid's nearest point. If `position_ws` is NULL, you get the first probe's lobes. The call
 * does not allocate. Any thread. Errors: INVALID_ARGUMENT (also if the basis is not
 * NOOK_PROBE_BASIS_LOBES). */
NOOK_API nook_result nook_probe_read_lobes(nook_probe probe, const float* position_ws, nook_lobe* lobes,
                                           uint32_t function_count);

/* Evaluates the radiance from `count` unit directions. `positions_ws` has a position for each direction
 * (world space, metres), at which the grid is interpolated; outside the grid you get the light at its nearest
 * point. With NULL, all directions use the first probe. Walls are ignored. Outside a probe's hemisphere, the
 * result is not meaningful. The call does not allocate. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_radiance(nook_probe probe, const float* positions_ws, const float* directions,
                                         float* radiance, size_t count);

/* Evaluates the irradiance on `count` surfaces with unit normals, at positions as in nook_probe_radiance. In
 * a grid that was baked with walls, a surface uses only the probes on its side of a wall. For lobes, the
 * clamped cosine is expanded in spherical harmonics up to band 4; the error is at most 0.2 % up to sharpness
 * 6, 1 % at 16, and 1.6 % above. For harmonics, the irradiance is exact. The result is not clamped at 0. The
 * call does not allocate. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_irradiance(nook_probe probe, const float* positions_ws, const float* normals,
                                           float* irradiance, size_t count);

#ifdef __cplusplus
}
#endif
#endif
