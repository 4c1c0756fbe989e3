/* Light probes: radiance over directions as a few basis functions. A probe is fitted by least squares while
 * its samples arrive, and evaluated as radiance, irradiance and glossy reflection. Its light is the light
 * that AO attenuates.
 *
 * A probe holds R(s) = sum_i b_i B_i(s), where b_i is an RGB coefficient for each function B_i. For spherical
 * Gaussians, called lobes, B_i(s) = exp(sharpness_i (dot(axis_i, s) - 1)) and b_i is the amplitude; an
 * ambient term is a lobe of sharpness 0. The fit minimises the integral of (R - f)^2 over the domain, f being
 * the radiance (T. Roughton, progressive least squares, 2018). G_ik is the integral of B_i B_k, and m_i the
 * integral of B_i f.
 *   Moments:          b = G^-1 m, with m estimated from samples.
 *   Least squares:    the same with G estimated from the same samples, which is the batch fit of all samples.
 *   Running average:  at each sample (w, v), with a the domain's area and n the weight so far,
 *                     b_i += (1 / n) (B_i(w) (v - sum over k != i of b_k B_k(w)) / D_i - b_i),
 *                     where D_i is an estimate of G_ii / a.
 *
 * In an integrator:
 *     nook_probe_fit_add_samples(fit, directions, radiance, NULL, count);      as often as there are samples
 *     nook_probe_fit_solve(fit, &probe);                                       at any time
 *
 * Directions are unit vectors that point away from the probe. Radiance is linear RGB in any unit, and
 * irradiance is in that unit times steradians. Irradiance E is the integral of L(s) max(dot(n, s), 0), so
 * that a Lambertian surface reflects the radiance albedo / pi * E * AO. Arrays of directions and colours hold
 * three floats for each entry, without padding. */
#ifndef NOOK_PROBE_H
#define NOOK_PROBE_H

#include "nook.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_probe_fit_s* nook_probe_fit;
typedef struct nook_probe_s* nook_probe;

/* ---- Lobes: plain data, with the same layout in std140 and std430 ---- */

/* The spherical Gaussian amplitude * exp(sharpness (dot(axis, s) - 1)). */
typedef struct nook_probe_lobe {
  /* Unit vector. */
  float axis[3];
  /* >= 0; 0 is constant over the sphere. */
  float sharpness;
  /* Linear RGB. */
  float amplitude[3];
  /* Must be 0. */
  float reserved;
} nook_probe_lobe;

/* The maximum number of functions of a probe. */
#define NOOK_PROBE_MAX_FUNCTIONS 64

/* The basis functions of a probe. */
enum {
  /* Lobes, and an ambient term if the descriptor has one: 3 floats each. */
  NOOK_PROBE_GAUSSIANS = 0,
  /* Real spherical harmonics of bands 0 to order, orthonormal over the sphere. */
  NOOK_PROBE_HARMONICS = 1,
  /* Ambient dice (Iwanicki and Sloan 2017): 0.35 c^2 + 0.25 c^4 with c = max(dot(v, s), 0), at the 12
   * vertices v of an icosahedron. */
  NOOK_PROBE_DICE = 2
};
typedef int32_t nook_probe_basis;

/* The directions over which a probe is fitted. */
enum {
  NOOK_PROBE_SPHERE = 0,
  /* The directions within 90 degrees of an axis, for lightmaps; a fit skips samples of the others. */
  NOOK_PROBE_HEMISPHERE = 1
};
typedef int32_t nook_probe_domain;

/* ---- Fits ---- */

/* The methods of a fit. */
enum {
  /* m_i / sum_k G_ik, and m_i / G_ii for harmonics. Constant light is exact, and other light is blurred. */
  NOOK_PROBE_NAIVE = 0,
  /* The running average in its corrected form, which has a solution after every sample. */
  NOOK_PROBE_RUNNING_AVERAGE = 1,
  /* The running average in its first published form, b_i += (1 / n) B_i (v - R) / mean of B_i, for
   * comparison. It has the same limit with about half the step, so that it converges far more slowly. Not
   * with harmonics. */
  NOOK_PROBE_RUNNING_AVERAGE_ORIGINAL = 2,
  /* A running average whose coefficients are never below 0. Not with harmonics. */
  NOOK_PROBE_RUNNING_AVERAGE_NON_NEGATIVE = 3,
  /* Moments with the exact Gram matrix. It merges exactly. */
  NOOK_PROBE_MOMENTS = 4,
  /* The most accurate method at any number of samples. It merges exactly. */
  NOOK_PROBE_LEAST_SQUARES = 5,
  /* Least squares with coefficients of at least 0, for small strong sources, whose unconstrained fit rings.
   * It merges exactly. Not with harmonics. */
  NOOK_PROBE_NON_NEGATIVE_LEAST_SQUARES = 6
};
typedef int32_t nook_probe_method;

/* A condition on the coefficients of lobes. Naive and original forms, harmonics and dice ignore it. */
enum {
  /* The lobes agree with the light in its spherical harmonics of bands 0 to 2, which make up 99 % of the
   * irradiance of a light. The total light is exact, and the error of irradiance is about a third of that of
   * least squares alone. The coefficients minimise the squared error of radiance under this condition. If it
   * cannot be satisfied (fewer than 9 lobes, coefficients that may not be negative, a hemisphere), they come
   * close to it. */
  NOOK_PROBE_CONSTRAINT_BANDS = 0,
  /* Least squares alone, for lobes so sharp that there are gaps between them. */
  NOOK_PROBE_CONSTRAINT_NONE = 1
};
typedef int32_t nook_probe_constraint;

/* D_i of the running average's plain step. */
enum {
  /* An average over the same samples that is never below the exact integral. */
  NOOK_PROBE_DENOMINATOR_LOCKSTEP = 0,
  /* The exact integral. */
  NOOK_PROBE_DENOMINATOR_PRECOMPUTED = 1
};
typedef int32_t nook_probe_denominator;

/* The step of running averages. */
enum {
  /* Recursive least squares by blocks of 1,024 samples: with S and m the block's sums of B_i B_k and B_i v
   * and n the weight before it, (n G / a + S) (b' - b) = m - S b. What is read inside a block is its solution
   * so far. Its error tends to that of batch least squares. The result of the non-negative form is the
   * non-negative coefficients that are nearest to b in the mean square. */
  NOOK_PROBE_STEP_FAST = 0,
  /* The step 1 / n as published and as written above; the non-negative form clamps after each sample. */
  NOOK_PROBE_STEP_PLAIN = 1
};
typedef int32_t nook_probe_step;

typedef struct nook_probe_fit_desc {
  /* nook_probe_fit_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* Default NOOK_PROBE_LEAST_SQUARES. */
  nook_probe_method method;
  /* Default NOOK_PROBE_CONSTRAINT_BANDS. */
  nook_probe_constraint constraint;
  /* Default NOOK_PROBE_GAUSSIANS. */
  nook_probe_basis basis;
  /* Default NOOK_PROBE_SPHERE. */
  nook_probe_domain domain;
  /* The axis of the hemisphere, of unit length to 1e-3. Default (0, 0, 1), the normal of a tangent space. */
  float up[3];
  /* For Gaussians: 1 to 64 with the ambient term; default 12. */
  uint32_t lobe_count;
  /* The sharpness of lobes without one in sharpnesses, in [0, 10000]. 0 (default): a value that depends on
   * lobe_count, so that neighbouring lobes always overlap alike; it is 6 for 12 lobes on the sphere. */
  float sharpness;
  /* lobe_count directions of unit length to 1e-3, which the call copies. NULL (default): a Vogel spiral. */
  const float* axes;
  /* lobe_count values in (0, 10000], which the call copies. NULL (default): `sharpness` for all. */
  const float* sharpnesses;
  /* 1: a constant term follows the lobes. Default 0. */
  int32_t ambient;
  /* For harmonics: the highest band, 1 to 4; default 2. */
  uint32_t order;
  /* Only the plain step uses it. Default NOOK_PROBE_DENOMINATOR_LOCKSTEP. */
  nook_probe_denominator denominator;
  /* Only running averages use it. Default NOOK_PROBE_STEP_FAST. */
  nook_probe_step step;
  /* Samples, >= 0, default 0: every sample has its own weight. Above 0, the weight of sample k, counted from
   * 1, is multiplied by 1 - exp(-k / growing_samples), for samples whose first radiances are noisy. */
  float growing_samples;
  /* Default NOOK_ISA_AUTO. An instruction set that the processor lacks fails with UNSUPPORTED. */
  nook_isa isa;
  /* Must be 0. */
  uint32_t reserved;
} nook_probe_fit_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_probe_fit_desc_init(nook_probe_fit_desc* desc, size_t size,
                                              uint32_t header_version);

/* Creates a fit without samples. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (also, two functions are equal, or so nearly equal that no fit can
 * separate them; the message names both), VERSION, UNSUPPORTED, OUT_OF_MEMORY. */
NOOK_API nook_result nook_probe_fit_create(nook_context context, const nook_probe_fit_desc* desc,
                                           nook_probe_fit* out);

/* Destroys the fit and sets *fit to NULL.
 * One at a time. */
NOOK_API void nook_probe_fit_destroy(nook_probe_fit* fit);

/* Adds samples of radiance. Samples of uniformly distributed directions have the weight 1; weights NULL means
 * that. A direction that was drawn with the probability density p over a domain of area a has the weight
 * 1 / (a p), so that the mean of all weights is 1; with another mean, running averages converge more slowly.
 * The fit skips and counts samples whose direction has no unit length to 1e-3 or lies outside the hemisphere,
 * whose direction, radiance or weight is not finite, or whose weight is negative; radiance and weights above
 * 1e18 count as infinite. Running averages need directions in random order: if the rows of an image arrive
 * one after another, the last rows dominate. The call does not allocate.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_fit_add_samples(nook_probe_fit fit, const float* directions,
                                                const float* radiance, const float* weights, size_t count);

/* Starts a running average that has no samples yet from the coefficients of short_run instead of 0; they
 * count as much as the samples of short_run did. Both fits must have the same basis. Methods that solve
 * ignore the call. Neither fit may be in use elsewhere.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_fit_seed(nook_probe_fit fit, nook_probe_fit short_run);

/* Adds the samples of other, such as a fit on another thread, to fit; both must have equal descriptors.
 * Methods that solve end with the sums of one fit with all samples, up to rounding. Running
 * averages, which depend on the order of their samples, become the average weighted by the samples' weights.
 * other stays as it is. Neither fit may be in use elsewhere.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_fit_merge(nook_probe_fit fit, nook_probe_fit other);

/* Removes all samples and the seed.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_fit_reset(nook_probe_fit fit);

/* Writes the present coefficients, function_count x RGB; they are 0 before the first sample. More samples may
 * follow. The call does not allocate.
 * One at a time. Errors: INVALID_ARGUMENT (also, function_count is not the fit's). */
NOOK_API nook_result nook_probe_fit_read(nook_probe_fit fit, float* coefficients, uint32_t function_count);

/* Creates a probe from the present coefficients. More samples may follow. On failure *out is NULL.
 * One at a time. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_probe_fit_solve(nook_probe_fit fit, nook_probe* out);

typedef struct nook_probe_fit_info {
  /* sizeof(nook_probe_fit_info); the caller sets it. */
  uint32_t struct_size;
  /* Lobes and ambient term, or harmonics, or 12 for ambient dice. */
  uint32_t function_count;
  /* Samples that the fit used. */
  uint64_t samples;
  /* Samples that the fit skipped: the sum of the next three. */
  uint64_t skipped;
  /* The direction was not finite, zero, not of unit length, or below the hemisphere. */
  uint64_t skipped_direction;
  /* The radiance was not finite. */
  uint64_t skipped_radiance;
  /* The weight was not finite, or negative. */
  uint64_t skipped_weight;
  /* The sum of the weights of the used samples. */
  double weight;
  /* The weighted mean of the used samples, with which the mean of a good fit agrees. */
  double mean_radiance[3];
} nook_probe_fit_info;

/* Describes a fit and counts its samples.
 * One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_fit_describe(nook_probe_fit fit, nook_probe_fit_info* info);

/* ---- Probes: immutable, one or a grid of them with common functions, shared by threads ---- */

typedef struct nook_probe_desc {
  /* nook_probe_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* A fit whose basis the probe takes; required. It may be destroyed after the call. */
  nook_probe_fit functions;
  /* The numbers of probes along x, y and z; their product is at most 1,048,576. Default 1, 1, 1. */
  uint32_t counts[3];
  /* Metres, the position of the first probe; default 0. */
  float origin_ws[3];
  /* Metres, > 0, between neighbours along x, y and z; default 1. */
  float spacing_ws[3];
  /* Must be 0. */
  uint32_t reserved;
  /* probe_count x function_count x RGB, where x varies fastest, then y, then z; required. The call copies
   * them. */
  const float* coefficients;
} nook_probe_desc;

/* Fills *desc with defaults, as nook_context_desc_init does.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_probe_desc_init(nook_probe_desc* desc, size_t size, uint32_t header_version);

/* Creates a probe or a grid from coefficients, such as those of nook_probe_fit_read. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT (also, a coefficient is not finite or its magnitude is above 1e22),
 * VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_probe_create(nook_context context, const nook_probe_desc* desc, nook_probe* out);

/* Loads a probe or a grid from the bytes of a .nook file; the caller may free the bytes afterwards. The
 * library validates everything, so that hostile bytes are safe. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_probe_load(nook_context context, const void* bytes, size_t size, nook_probe* out);

/* Releases the caller's reference and sets *probe to NULL.
 * Any thread. */
NOOK_API void nook_probe_destroy(nook_probe* probe);

/* The storage of an RGB coefficient in a file. */
enum {
  /* 12 bytes, exact. */
  NOOK_PROBE_PACKING_FLOAT = 0,
  /* 6 bytes. For each channel, the relative error is at most 2^-11 from 6.1e-5 to 65504, and the absolute
   * error at most 3e-8 below. Larger values fail with INVALID_ARGUMENT. */
  NOOK_PROBE_PACKING_HALF = 1,
  /* 4 bytes. The error is at most 2^-9 of the largest of the three channels, where that is 3.1e-5 to 65408.
   * Negative channels and larger values fail with INVALID_ARGUMENT. */
  NOOK_PROBE_PACKING_RGB9E5 = 2
};
typedef int32_t nook_probe_packing;

/* Writes the .nook file of a probe to bytes; the host stores it. *size is the buffer's size before the call
 * and the file's size afterwards. With bytes NULL the call gives only the size. It allocates from the C++
 * heap.
 * Any thread. Errors: INVALID_ARGUMENT (also, the buffer is too small; *size is then the required size),
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_probe_save(nook_probe probe, nook_probe_packing packing, void* bytes, size_t* size);

typedef struct nook_probe_info {
  /* sizeof(nook_probe_info); the caller sets it. */
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
  uint32_t probe_count;
  /* The numbers of probes along x, y and z. */
  uint32_t counts[3];
  /* Metres, the position of the first probe. */
  float origin_ws[3];
  /* Metres between neighbours along x, y and z. */
  float spacing_ws[3];
  /* The number of cells between probes in which walls choose among the probes; 0: the grid has no walls. */
  uint32_t wall_cells;
} nook_probe_info;

/* Describes a probe.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_describe(nook_probe probe, nook_probe_info* info);

/* Writes the coefficients of one probe of the grid, function_count x RGB.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_read_coefficients(nook_probe probe, uint32_t index, float* coefficients,
                                                  uint32_t function_count);

/* Writes the lobes at a point (world space, metres), trilinearly interpolated between the probes of a grid.
 * Outside the grid they are those of its nearest point. With position_ws NULL they are those of the first
 * probe. The call does not allocate.
 * Any thread. Errors: INVALID_ARGUMENT (also, the basis is not NOOK_PROBE_GAUSSIANS). */
NOOK_API nook_result nook_probe_read_lobes(nook_probe probe, const float* position_ws, nook_probe_lobe* lobes,
                                           uint32_t function_count);

/* The method that computes the irradiance of a lobe. */
enum {
  /* S. Hill's fit of a lobe under the clamped cosine. Its error is at most 1.6 % of the irradiance of a light
   * that is perpendicular to the surface. Below sharpness 3, where the fit is not defined, the bands are
   * used. */
  NOOK_PROBE_IRRADIANCE_FITTED = 0,
  /* The clamped cosine as a lobe. It costs less, and is never 0 behind a light. */
  NOOK_PROBE_IRRADIANCE_INNER_PRODUCT = 1,
  /* The clamped cosine in spherical harmonics up to band 4. Its error is at most 0.2 % up to sharpness 6 and
   * 1 % at 16; above, the fitted form is used. */
  NOOK_PROBE_IRRADIANCE_BANDS = 2
};
typedef int32_t nook_probe_irradiance_form;

/* Evaluates the radiance from count unit directions at a point, which is given as in nook_probe_read_lobes.
 * The functions of a hemisphere are defined below it, but no samples were fitted there. The call does not
 * allocate.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_radiance(nook_probe probe, const float* position_ws, const float* directions,
                                         float* radiance, size_t count);

/* Evaluates the irradiance on count surfaces with the given unit normals at a point, as nook_probe_radiance
 * does. form only affects lobes; harmonics and ambient dice are convolved exactly. The call does not
 * allocate.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_irradiance(nook_probe probe, const float* position_ws,
                                           nook_probe_irradiance_form form, const float* normals,
                                           float* irradiance, size_t count);

/* Evaluates the irradiance on count surfaces, each with a position (world space, metres) and a unit normal of
 * its own, as the GLSL of nook_gl_probe_grid_describe does before it clamps at 0. In a grid that was baked
 * with walls, only the probes on the surface's side of a wall count; in other grids, and far from walls, the
 * result is that of nook_probe_irradiance. The call does not allocate.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_surface_irradiance(nook_probe probe, nook_probe_irradiance_form form,
                                                   const float* positions_ws, const float* normals,
                                                   float* irradiance, size_t count);

/* ---- Arithmetic of lobes: the maximum is NOOK_PROBE_MAX_FUNCTIONS lobes, and no call allocates ---- */

/* Evaluates the radiance of lobes from count unit directions.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_lobes_radiance(const nook_probe_lobe* lobes, uint32_t lobe_count,
                                               const float* directions, float* radiance, size_t count);

/* Evaluates the irradiance of lobes on count surfaces with the given unit normals.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_lobes_irradiance(const nook_probe_lobe* lobes, uint32_t lobe_count,
                                                 nook_probe_irradiance_form form, const float* normals,
                                                 float* irradiance, size_t count);

/* The shape of what a surface reflects to the eye. */
enum {
  /* One spherical Gaussian (after Wang et al. 2009). */
  NOOK_PROBE_SPECULAR_ISOTROPIC = 0,
  /* Four of them round normals that the eye sees (Heitz 2018), which stretch at grazing views and where the
   * two widths differ. */
  NOOK_PROBE_SPECULAR_ANISOTROPIC = 1
};
typedef int32_t nook_probe_specular_form;

typedef struct nook_probe_surface {
  /* Unit vector. */
  float normal[3];
  /* Unit vector from the surface to the eye. */
  float view[3];
  /* Unit vector perpendicular to the normal. It is only read where alpha_x and alpha_y differ. */
  float tangent[3];
  /* The GGX width along the tangent, roughness squared, in [0.001, 1]. */
  float alpha_x;
  /* The width across the tangent. The isotropic form takes the geometric mean of both. */
  float alpha_y;
  /* The reflectance at normal incidence (Schlick), in [0, 1]. */
  float reflectance;
} nook_probe_surface;

/* Evaluates the radiance that GGX surfaces reflect to the eye, one colour for each surface: Smith masking of
 * both directions whose heights correlate (Heitz 2014, as engines shade their lights), Schlick Fresnel,
 * single scattering. The result is the directional albedo times the mean of the light over the reflected
 * lobes. The following errors hold where the cosine between normal and view is 0.02 to 1. Under constant
 * light the result is within 5 % of the integral for reflectances from 0.02 on. Under 12 lobes of sharpness 6
 * whose amplitudes differ by up to 1 : 9 it is within 9 % in the anisotropic form and 13 % in the isotropic
 * one. If one lobe is 20 times as bright as all others it is within 40 %. Surfaces with two widths are within
 * 14 % in the anisotropic form; under constant light they are within 5 % at reflectance 1 and 20 % at 0.04.
 * docs/probes.md has the errors under lobes of real maps. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_lobes_specular(const nook_probe_lobe* lobes, uint32_t lobe_count,
                                               nook_probe_specular_form form,
                                               const nook_probe_surface* surfaces, float* rgb, size_t count);

/* Computes the integral of a lobe over the sphere.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_lobe_integral(const nook_probe_lobe* lobe, float rgb[3]);

/* Computes the integral over the sphere of the product of two lobes, whose amplitudes multiply by channel.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_lobe_product_integral(const nook_probe_lobe* a, const nook_probe_lobe* b,
                                                      float rgb[3]);

/* Computes the product of two lobes, which is exactly one lobe.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_lobe_product(const nook_probe_lobe* a, const nook_probe_lobe* b,
                                             nook_probe_lobe* out);

/* Computes a lobe about the axis of a that approximates a convolved with b: it has the integral and the mean
 * cosine of the convolution.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_lobe_convolution(const nook_probe_lobe* a, const nook_probe_lobe* b,
                                                 nook_probe_lobe* out);

/* Rotates the axes of lobes by a 3x3 matrix, row-major and orthonormal to 1e-3.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_lobes_rotate(nook_probe_lobe* lobes, uint32_t lobe_count,
                                             const float rotation[9]);

/* Projects lobes exactly onto real spherical harmonics of bands 0 to order (1 to 4). coefficients receives
 * (order + 1)^2 x RGB, band by band from m = -l to l, without the Condon-Shortley phase: 0.282095, 0.488603
 * (y, z, x), and so on.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_lobes_to_harmonics(const nook_probe_lobe* lobes, uint32_t lobe_count,
                                                   uint32_t order, float* coefficients);

/* ---- Light as spherical harmonics: plain arrays, with the lowest error of diffuse light for their size ----
 *
 * Coefficients are (order + 1)^2 x RGB in the order of nook_probe_lobes_to_harmonics, which gives them from
 * lobes; nook_probe_fit_read of a fit of NOOK_PROBE_HARMONICS gives them from samples. No call allocates.
 * shaders/probe/harmonics.glsl evaluates bands 0 to 2 (27 floats), and ZH3 (15 floats). */

/* Evaluates the radiance from count unit directions, exactly for these bands. order is 1 to 4. The result is
 * not clamped at 0: harmonics ring below 0 opposite a sun.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_harmonics_radiance(const float* coefficients, uint32_t order,
                                                   const float* directions, float* rgb, size_t count);

/* Evaluates the irradiance on count surfaces with the given unit normals, exactly for these bands. order is 1
 * to 4. The result is not clamped at 0.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_harmonics_irradiance(const float* coefficients, uint32_t order,
                                                     const float* normals, float* rgb, size_t count);

/* Computes quadratic zonal harmonics, ZH3 (Roughton et al. 2024), from bands 0 to 2, 9 x RGB. The result is 5
 * x RGB: bands 0 and 1 unchanged, then the coefficient of the part of band 2 that is symmetric about the
 * direction of band 1's luminance. It may be interpolated and packed as other coefficients.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_harmonics_to_zonal(const float* coefficients, float* zonal);

/* Evaluates the radiance of ZH3 from count unit directions.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_zonal_radiance(const float* zonal, const float* directions, float* rgb,
                                               size_t count);

/* Evaluates the irradiance of ZH3 on count surfaces with the given unit normals.
 * Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_zonal_irradiance(const float* zonal, const float* normals, float* rgb,
                                                 size_t count);

#ifdef __cplusplus
}
#endif
#endif
