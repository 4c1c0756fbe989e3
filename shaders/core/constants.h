// Constants of spherical Gaussians, for sdk/src/core/spherical_gaussian.h and for shaders. The header
// describes the formulas. Both C++ and GLSL include this file.
#ifndef NOOK_CORE_CONSTANTS_H
#define NOOK_CORE_CONSTANTS_H

// The lobe that approximates the clamped cosine, with B. Karis' values.
#define NOOK_COSINE_LOBE_SHARPNESS 2.133
#define NOOK_COSINE_LOBE_AMPLITUDE 1.17

// The slope of the middle part of S. Hill's fit of the irradiance of a lobe.
#define NOOK_FITTED_IRRADIANCE_SLOPE 0.36
// Below this sharpness, the bands are used instead of the fit.
#define NOOK_FITTED_IRRADIANCE_MIN_SHARPNESS 3.0
// Up to this sharpness, the most accurate form (gaussian_unit_irradiance_best) uses the bands.
#define NOOK_BANDS_MAX_SHARPNESS 16.0
#endif
