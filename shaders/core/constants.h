// Constants of spherical Gaussians in sdk/src/core/spherical_gaussian.h and in the shaders; the header
// describes them. C++ and GLSL both include this file.
#ifndef NOOK_CORE_CONSTANTS_H
#define NOOK_CORE_CONSTANTS_H

// The clamped cosine as a lobe: B. Karis' values.
#define NOOK_COSINE_LOBE_SHARPNESS 2.133
#define NOOK_COSINE_LOBE_AMPLITUDE 1.17

// S. Hill's fit of the irradiance of a lobe: the slope of its middle part.
#define NOOK_FITTED_IRRADIANCE_SLOPE 0.36
// Below this sharpness, the bands replace the fit.
#define NOOK_FITTED_IRRADIANCE_MIN_SHARPNESS 3.0
// Up to this sharpness, the best form uses the bands.
#define NOOK_BANDS_MAX_SHARPNESS 16.0
#endif
