// Constants of spherical Gaussians that sdk/src/core/spherical_gaussian.h and the shaders share; the header
// describes them. C++ and GLSL both include this file.
#ifndef NOOK_CORE_CONSTANTS_H
#define NOOK_CORE_CONSTANTS_H

// The clamped cosine as a lobe: B. Karis' values.
#define NOOK_COSINE_LOBE_SHARPNESS 2.133
#define NOOK_COSINE_LOBE_AMPLITUDE 1.17

// S. Hill's fit of the irradiance of a lobe: the slope of its middle part.
#define NOOK_FITTED_IRRADIANCE_SLOPE 0.36
// The fit takes the bands below this sharpness.
#define NOOK_FITTED_IRRADIANCE_MIN_SHARPNESS 3.0
// The best form takes the bands up to this sharpness.
#define NOOK_BANDS_MAX_SHARPNESS 16.0
#endif
