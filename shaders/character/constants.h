// Constants of the formulas in sdk/src/character (kernel.h, directional_occlusion.h) and in these shaders.
// The headers describe the formulas. C++ and GLSL both include this file.
#ifndef NOOK_CHARACTER_CONSTANTS_H
#define NOOK_CHARACTER_CONSTANTS_H

// Forms of a model's kernel.
#define NOOK_KERNEL_PAPER 0
#define NOOK_KERNEL_NOOK 1
#define NOOK_KERNEL_RATIONAL 2

#define NOOK_MIN_SPHERE_RADIUS 1e-6  // metres; a smaller radius is replaced by this one
#define NOOK_KERNEL_CORE 0.6

// form_factor_fast: the absolute values of the coefficients of the polynomial P(b, t).
#define NOOK_FORM_FACTOR_0 4.60908
#define NOOK_FORM_FACTOR_1 5.21348
#define NOOK_FORM_FACTOR_2 3.22202
#define NOOK_FORM_FACTOR_3 2.22202

#define NOOK_SOLID_DEPTH 0.3  // solid_depth

#define NOOK_CASTER_CONCENTRATION 2.0
#define NOOK_SELF_CONCENTRATION 1.0
#define NOOK_SELF_STRENGTH 0.75
#define NOOK_SMALLEST_SHARE 1e-4
#define NOOK_LARGEST_RATIO 8.0
#define NOOK_NO_SHARPEST 1e6

// share_below uses the width of the lobe's profile, and the coefficients of Abramowitz & Stegun 7.1.27.
#define NOOK_BELOW_WIDTH 5.09
#define NOOK_BELOW_1 0.278393
#define NOOK_BELOW_2 0.230389
#define NOOK_BELOW_3 0.000972
#define NOOK_BELOW_4 0.078108

// lobe_norm: the coefficients of the power series of (e^(2 v) - 1) / v.
#define NOOK_LOBE_NORM_0 2.0
#define NOOK_LOBE_NORM_1 2.0
#define NOOK_LOBE_NORM_2 1.3333333
#define NOOK_LOBE_NORM_3 0.66666667
#define NOOK_LOBE_NORM_4 0.26666667

#endif
