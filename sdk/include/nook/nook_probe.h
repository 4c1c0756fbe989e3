/* Light probes: radiance over directions as a few basis functions, fitted by least squares while its samples arrive, and
 * evaluated as radiance, irradiance and glossy reflection. This is the light that AO attenuates.
 *
 * A probe holds R(s) = sum_i b_i B_i(s), b_i one RGB coefficient for each function. Of spherical Gaussians, the lobes,
 * B_i(s) = exp(sharpness_i (dot(axis_i, s) - 1)) and b_i is the amplitude; an ambient term is a lobe of sharpness 0. The fit
 * minimises the integral of (R - f)^2 over the domain (T. Roughton, progressive least squares, 2018). With G_ik the integral
 * of B_i B_k and m_i that of B_i f:
 *   moments        b = G^-1 m, m estimated from samples
 *   least squares  the same with G estimated from the same samples: what a batch fit of all of them gives
 *   running average, at each sample (w, v), a the domain's area, n the weight so far
 *                  b_i += (1 / n) (B_i(w) (v - sum over k != i of b_k B_k(w)) / D_i - b_i),  D_i an estimate of G_ii / a
 *
 * In an integrator:
 *     nook_probe_fit_add_samples(fit, directions, radiance, NULL, count);      as often as there are samples
 *     nook_probe_fit_solve(fit, &probe);                                       at any time
 *
 * Directions are unit vectors away from the probe; radiance is linear RGB in any unit, which irradiance then has times
 * steradians. Irradiance E is the integral of L(s) max(dot(n, s), 0): what a Lambertian surface sends back is
 * albedo / pi * E * AO. Arrays of directions and colours are three floats an entry, packed. */
#ifndef NOOK_PROBE_H
#define NOOK_PROBE_H

#include "nook.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_probe_fit_s* nook_probe_fit;
typedef struct nook_probe_s* nook_probe;

/* ---- Lobes: plain data, the same layout in std140 and std430 ---- */

/* amplitude * exp(sharpness (dot(axis, s) - 1)). */
typedef struct nook_probe_lobe {
  float axis[3];      /* unit */
  float sharpness;    /* >= 0; 0 is constant over the sphere */
  float amplitude[3]; /* linear RGB */
  float reserved;     /* 0 */
} nook_probe_lobe;

/* The largest number of functions of a probe. */
#define NOOK_PROBE_MAX_FUNCTIONS 64

enum {
  NOOK_PROBE_GAUSSIANS = 0, /* lobes, and an ambient term if asked for: 3 floats each */
  NOOK_PROBE_HARMONICS = 1, /* real spherical harmonics of bands 0 to order, orthonormal over the sphere */
  NOOK_PROBE_DICE = 2       /* ambient dice (Iwanicki & Sloan 2017): 0.35 c^2 + 0.25 c^4, c = max(dot(v, s), 0), at the 12
                               vertices v of an icosahedron */
};
typedef int32_t nook_probe_basis;

enum {
  NOOK_PROBE_SPHERE = 0,
  NOOK_PROBE_HEMISPHERE = 1 /* directions within 90 degrees of an axis, for lightmaps; others are skipped */
};
typedef int32_t nook_probe_domain;

/* ---- Fits ---- */

enum {
  NOOK_PROBE_NAIVE = 0,                        /* m_i / sum_k G_ik, of harmonics m_i / G_ii: constant light comes back, the
                                                  rest is blurred */
  NOOK_PROBE_RUNNING_AVERAGE = 1,              /* corrected form; a fit after every sample */
  NOOK_PROBE_RUNNING_AVERAGE_ORIGINAL = 2,     /* the first published form: b_i += (1 / n) B_i (v - R) / mean of B_i. For
                                                  comparison: it tends to the same with about half the step, far slower.
                                                  Not with harmonics */
  NOOK_PROBE_RUNNING_AVERAGE_NON_NEGATIVE = 3, /* no coefficient below 0 at any time. Not with harmonics */
  NOOK_PROBE_MOMENTS = 4,                      /* the Gram matrix is known; merges exactly */
  NOOK_PROBE_LEAST_SQUARES = 5,                /* the most accurate at any number of samples; merges exactly */
  NOOK_PROBE_NON_NEGATIVE_LEAST_SQUARES = 6    /* merges exactly; for tiny strong sources, whose fit rings. Not with
                                                  harmonics */
};
typedef int32_t nook_probe_method;

enum {
  NOOK_PROBE_DENOMINATOR_LOCKSTEP = 0,   /* averaged from the same samples, never below the true integral */
  NOOK_PROBE_DENOMINATOR_PRECOMPUTED = 1 /* the true integral */
};
typedef int32_t nook_probe_denominator;

enum {
  NOOK_PROBE_STEP_FAST = 0, /* recursive least squares with the known Gram matrix: with K = a G^-1 B(w), p = dot(K, B(w)),
                               b += K (v - R) / (n + p). Its error tends to that of batch least squares. Non-negative: the
                               answer is the non-negative coefficients nearest to b in the mean square */
  NOOK_PROBE_STEP_PLAIN = 1 /* as published and above, 1 / n; non-negative: clamped after each sample */
};
typedef int32_t nook_probe_step;

typedef struct nook_probe_fit_desc {
  uint32_t struct_size;               /* set by nook_probe_fit_desc_init */
  uint32_t header_version;            /* set by nook_probe_fit_desc_init */
  const void* next;                   /* NULL */
  nook_probe_method method;           /* default NOOK_PROBE_RUNNING_AVERAGE */
  nook_probe_basis basis;             /* default NOOK_PROBE_GAUSSIANS */
  nook_probe_domain domain;           /* default NOOK_PROBE_SPHERE */
  float up[3];                        /* the hemisphere's axis, unit to 1e-3; default (0, 0, 1), a tangent space */
  uint32_t lobe_count;                /* Gaussians: 1 to 64, with the ambient term; default 12 */
  float sharpness;                    /* of lobes without one of their own: above 0 to 10,000; 0 (default): by lobe_count, so
                                         that neighbours overlap alike. 6 for 12 lobes on the sphere */
  const float* axes;                  /* lobe_count directions, unit to 1e-3, copied; NULL (default): a Vogel spiral */
  const float* sharpnesses;           /* lobe_count values above 0 to 10,000, copied; NULL (default): `sharpness` for all */
  int32_t ambient;                    /* 1: a constant term follows the lobes. Default 0 */
  uint32_t order;                     /* harmonics: the highest band, 1 to 4; default 2 */
  nook_probe_denominator denominator; /* of the plain step; default NOOK_PROBE_DENOMINATOR_LOCKSTEP */
  nook_probe_step step;               /* running averages; default NOOK_PROBE_STEP_FAST */
  float growing_samples;              /* above 0: sample k, from 1, weighs 1 - exp(-k / this) times as much, against noise
                                         in the first samples' radiance; >= 0, default 0: all alike */
  nook_isa isa;                       /* default NOOK_ISA_AUTO; a better one than the processor has: UNSUPPORTED */
  uint32_t reserved;                  /* 0 */
} nook_probe_fit_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_probe_fit_desc_init(nook_probe_fit_desc* desc, size_t size, uint32_t header_version);

/* On failure *out is NULL. Any thread. Errors: INVALID_ARGUMENT (also: two functions are equal, or so nearly that no fit can
 * tell them apart; the message names both), UNSUPPORTED, OUT_OF_MEMORY. */
NOOK_API nook_result nook_probe_fit_create(nook_context context, const nook_probe_fit_desc* desc, nook_probe_fit* out);

/* Sets *fit to NULL. One at a time. */
NOOK_API void nook_probe_fit_destroy(nook_probe_fit* fit);

/* Samples of uniformly distributed directions have weight 1 (weights NULL); those drawn with probability density p over a
 * domain of area a have 1 / (a p): sampled by luminance, bright directions weigh little. The mean of all weights is 1: running averages that see
 * others settle slower. Samples whose direction is not
 * unit to 1e-3, or outside the hemisphere, whose direction, radiance or weight is not finite, or whose weight is negative,
 * are skipped and counted; radiance and weights above 1e18 count as infinite. Running averages want directions in random
 * order: rows of an image, one after the other, leave them with the last ones. No allocation. One at a time.
 * Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_fit_add_samples(nook_probe_fit fit, const float* directions, const float* radiance,
                                                const float* weights, size_t count);

/* The coefficients of `short_run`, of the same basis, become the start of a running average that has no samples yet, instead
 * of 0, and go on counting as much as the samples of short_run. Forms that solve ignore it.
 * One at a time (for both). Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_fit_seed(nook_probe_fit fit, nook_probe_fit short_run);

/* Adds to `fit` what `other`, made with an equal descriptor, has seen, e.g. on another thread. Forms that solve end with
 * exactly the sums of one fit that saw all samples, to rounding of double; running averages, which depend on the order of
 * their samples, become the average by weight. other stays as it is. One at a time (for both). Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_fit_merge(nook_probe_fit fit, nook_probe_fit other);

/* Forgets samples and seed. One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_fit_reset(nook_probe_fit fit);

/* The coefficients now, function_count x RGB; 0 before the first sample. The fit can go on afterwards. No allocation.
 * One at a time. Errors: INVALID_ARGUMENT (function_count is not the fit's). */
NOOK_API nook_result nook_probe_fit_read(nook_probe_fit fit, float* coefficients, uint32_t function_count);

/* nook_probe_fit_read into a new probe. On failure *out is NULL. One at a time. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_probe_fit_solve(nook_probe_fit fit, nook_probe* out);

typedef struct nook_probe_fit_info {
  uint32_t struct_size;      /* sizeof(nook_probe_fit_info), set by the caller */
  uint32_t function_count;   /* lobes and ambient term, harmonics, or 12 */
  uint64_t samples;          /* used */
  uint64_t skipped;          /* not used, for any reason; the sum of the next three */
  uint64_t skipped_direction; /* not finite, zero, not unit, or below the hemisphere */
  uint64_t skipped_radiance; /* not finite */
  uint64_t skipped_weight;   /* not finite, or negative */
  double weight;             /* sum of the weights of the samples used */
  double mean_radiance[3];   /* weighted mean of the samples: what the mean of the fit should be */
} nook_probe_fit_info;
/* One at a time. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_fit_describe(nook_probe_fit fit, nook_probe_fit_info* info);

/* ---- Probes: immutable, one or a grid of them with shared functions; shared by any number of threads ---- */

typedef struct nook_probe_desc {
  uint32_t struct_size;      /* set by nook_probe_desc_init */
  uint32_t header_version;   /* set by nook_probe_desc_init */
  const void* next;          /* NULL */
  nook_probe_fit functions;  /* a fit whose basis the probe has; required. It need not outlive the call */
  uint32_t counts[3];        /* probes along x, y, z, at most 1,048,576 in all; default 1, 1, 1 */
  float origin_ws[3];        /* metres, of the first probe; default 0 */
  float spacing_ws[3];       /* metres between neighbours along x, y, z; above 0; default 1 */
  uint32_t reserved;         /* 0 */
  const float* coefficients; /* probe_count x function_count x RGB, x fastest, then y, z; required, copied */
} nook_probe_desc;

/* Fills *desc with defaults, as nook_context_desc_init does. Any thread. Errors: INVALID_ARGUMENT, VERSION. */
NOOK_API nook_result nook_probe_desc_init(nook_probe_desc* desc, size_t size, uint32_t header_version);

/* A probe or grid from coefficients, such as nook_probe_fit_read's. On failure *out is NULL. Any thread.
 * Errors: INVALID_ARGUMENT (also: a coefficient is not finite or above 1e22 in magnitude), OUT_OF_MEMORY. */
NOOK_API nook_result nook_probe_create(nook_context context, const nook_probe_desc* desc, nook_probe* out);

/* Loads a probe or a grid from the bytes of a .nook file, which may be freed afterwards. Everything is validated; safe on
 * hostile bytes. On failure *out is NULL. Any thread. Errors: INVALID_ARGUMENT, BAD_FILE, FILE_VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_probe_load(nook_context context, const void* bytes, size_t size, nook_probe* out);

/* Releases the caller's hold and sets *probe to NULL. Any thread. */
NOOK_API void nook_probe_destroy(nook_probe* probe);

enum {
  NOOK_PROBE_PACKING_FLOAT = 0,  /* 12 bytes a coefficient, exact */
  NOOK_PROBE_PACKING_HALF = 1,   /* 6 bytes; relative error <= 2^-11 of each channel from 6.1e-5 to 65504, absolute error
                                    <= 3e-8 below. Above: INVALID_ARGUMENT */
  NOOK_PROBE_PACKING_RGB9E5 = 2  /* 4 bytes; no negative channel; error <= 2^-9 of the largest of the three channels, from
                                    3.1e-5 to 65408. Otherwise: INVALID_ARGUMENT */
};
typedef int32_t nook_probe_packing;

/* Writes the .nook file of a probe to bytes. *size: the buffer's size on entry, the file's afterwards; bytes NULL: the size
 * alone. The host writes the file. Allocates with malloc. Any thread. Errors: INVALID_ARGUMENT (also: the buffer is too
 * small, *size then says how much is needed), OUT_OF_MEMORY. */
NOOK_API nook_result nook_probe_save(nook_probe probe, nook_probe_packing packing, void* bytes, size_t* size);

typedef struct nook_probe_info {
  uint32_t struct_size;    /* sizeof(nook_probe_info), set by the caller */
  nook_probe_basis basis;
  nook_probe_domain domain;
  float up[3];             /* the hemisphere's axis */
  uint32_t function_count;
  int32_t ambient;         /* 1: the last function is a constant term, a lobe of sharpness 0 */
  uint32_t order;          /* of harmonics, else 0 */
  uint32_t probe_count;
  uint32_t counts[3];      /* along x, y, z */
  float origin_ws[3];
  float spacing_ws[3];
} nook_probe_info;
/* Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_describe(nook_probe probe, nook_probe_info* info);

/* The coefficients of one probe of the grid. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_read_coefficients(nook_probe probe, uint32_t index, float* coefficients,
                                                  uint32_t function_count);

/* The lobes at a point, with trilinear weights between the probes of a grid; outside it, those of its nearest point.
 * position_ws (metres) NULL: the lobes of the first probe. No allocation. Any thread. Errors: INVALID_ARGUMENT (also: the basis is not NOOK_PROBE_GAUSSIANS). */
NOOK_API nook_result nook_probe_read_lobes(nook_probe probe, const float* position_ws, nook_probe_lobe* lobes,
                                           uint32_t function_count);

enum {
  NOOK_PROBE_IRRADIANCE_FITTED = 0,        /* S. Hill's fit of a lobe under the clamped cosine: within 1.6 % of what a light
                                              gives straight on; below sharpness 3, its range, the bands */
  NOOK_PROBE_IRRADIANCE_INNER_PRODUCT = 1, /* the clamped cosine as a lobe; cheaper, and never 0 behind a light */
  NOOK_PROBE_IRRADIANCE_BANDS = 2          /* the clamped cosine in spherical harmonics to band 4: within 0.2 % up to
                                              sharpness 6, 1 % at 16; the fit above */
};
typedef int32_t nook_probe_irradiance_form;

/* Radiance from `count` unit directions, and irradiance on `count` unit normals, at a point as nook_probe_read_lobes has it.
 * `form` matters to lobes alone; harmonics and ambient dice are convolved exactly. A hemisphere's functions go on below it,
 * but nothing was fitted there. No allocation. Any thread. Errors: INVALID_ARGUMENT. */
NOOK_API nook_result nook_probe_radiance(nook_probe probe, const float* position_ws, const float* directions,
                                         float* radiance, size_t count);
NOOK_API nook_result nook_probe_irradiance(nook_probe probe, const float* position_ws, nook_probe_irradiance_form form,
                                           const float* normals, float* irradiance, size_t count);

/* ---- Arithmetic of at most NOOK_PROBE_MAX_FUNCTIONS lobes. No allocation. Any thread. Errors: INVALID_ARGUMENT ---- */

NOOK_API nook_result nook_probe_lobes_radiance(const nook_probe_lobe* lobes, uint32_t lobe_count, const float* directions,
                                               float* radiance, size_t count);
NOOK_API nook_result nook_probe_lobes_irradiance(const nook_probe_lobe* lobes, uint32_t lobe_count,
                                                 nook_probe_irradiance_form form, const float* normals, float* irradiance,
                                                 size_t count);

enum {
  NOOK_PROBE_SPECULAR_ISOTROPIC = 0,  /* the reflected lobe is a spherical Gaussian (Wang et al. 2009) */
  NOOK_PROBE_SPECULAR_ANISOTROPIC = 1 /* an anisotropic one (after Xu et al. 2013), which stretches at grazing views */
};
typedef int32_t nook_probe_specular_form;

typedef struct nook_probe_surface {
  float normal[3];    /* unit */
  float view[3];      /* unit, from the surface to the eye */
  float tangent[3];   /* unit, across the normal; only read where alpha_x and alpha_y differ */
  float alpha_x;      /* GGX width along the tangent, roughness squared; 0.001 to 1 */
  float alpha_y;      /* across it; the isotropic form takes their geometric mean */
  float reflectance;  /* at normal incidence, 0 to 1 (Schlick) */
} nook_probe_surface;

/* Radiance that a GGX surface reflects to the eye: Smith masking of both directions, Schlick Fresnel, single scattering; its
 * directional albedo times the light's mean over the lobe that it reflects. rgb: one colour for each surface. Seen from 0.02
 * to 1, the cosine between normal and view: under constant light within 5 % of the integral from reflectance 0.02 on, and
 * under 12 lobes of sharpness 6 within 7 % (anisotropic form: 6 % at alpha 0.05 and 0.1, 13 % at 0.2, 7 % above). Surfaces of
 * two widths, anisotropic form: 22 %; under constant light 6 % at reflectance 1, 26 % at 0.04. */
NOOK_API nook_result nook_probe_lobes_specular(const nook_probe_lobe* lobes, uint32_t lobe_count,
                                               nook_probe_specular_form form, const nook_probe_surface* surfaces,
                                               float* rgb, size_t count);

/* The integral over the sphere; of the product of two; the product, which is one lobe again; and a lobe that stands for a
 * convolved with b, round a's axis, with the integral and the mean cosine that the convolution has. Amplitudes multiply by
 * channel. */
NOOK_API nook_result nook_probe_lobe_integral(const nook_probe_lobe* lobe, float rgb[3]);
NOOK_API nook_result nook_probe_lobe_product_integral(const nook_probe_lobe* a, const nook_probe_lobe* b, float rgb[3]);
NOOK_API nook_result nook_probe_lobe_product(const nook_probe_lobe* a, const nook_probe_lobe* b, nook_probe_lobe* out);
NOOK_API nook_result nook_probe_lobe_convolution(const nook_probe_lobe* a, const nook_probe_lobe* b, nook_probe_lobe* out);

/* Turns the axes by a 3x3 rotation, row-major, orthonormal to 1e-3. */
NOOK_API nook_result nook_probe_lobes_rotate(nook_probe_lobe* lobes, uint32_t lobe_count, const float rotation[9]);

/* The lobes' projection onto spherical harmonics of bands 0 to order (1 to 4), exact: (order + 1)^2 x RGB, band by band from
 * m = -l to l, no Condon-Shortley phase: 0.282095, 0.488603 (y, z, x), ... */
NOOK_API nook_result nook_probe_lobes_to_harmonics(const nook_probe_lobe* lobes, uint32_t lobe_count, uint32_t order,
                                                   float* coefficients);

#ifdef __cplusplus
}
#endif
#endif
