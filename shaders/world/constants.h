// Constants of formulas in sdk/src/world (coverage.h, cone.h) and in these shaders. The headers describe the
// formulas. Both C++ and GLSL include this file.
#ifndef NOOK_WORLD_CONSTANTS_H
#define NOOK_WORLD_CONSTANTS_H

// The coefficients of an arc cosine with an error of at most 7e-5: Abramowitz and Stegun 4.4.45.
#define NOOK_ARC_0 1.5707288
#define NOOK_ARC_1 -0.2121144
#define NOOK_ARC_2 0.0742610
#define NOOK_ARC_3 -0.0187293

// If the squared sine of the angle between the ends of a capsule is below this, the ends are treated as one
// point.
#define NOOK_SMALLEST_SPREAD 1e-6
// The largest sine of the angular radius of a capsule's end. It is just below 1. For a point on the surface
// of the end, the sine would be 1.
#define NOOK_LARGEST_SINE 0.9999

// The coefficients of the two polynomials w1 and w2 in b, which coverage.h uses for regions that the horizon
// cuts. Each is w = b (c0 + b (c1 + b c2)).
#define NOOK_HORIZON_10 1.09177
#define NOOK_HORIZON_11 -1.52723
#define NOOK_HORIZON_12 0.68546
#define NOOK_HORIZON_20 -0.49913
#define NOOK_HORIZON_21 1.05297
#define NOOK_HORIZON_22 -0.51604

// w1 and w2 of a small disc, where b = 1. They are sums of the coefficients above.
#define NOOK_HORIZON_FAR_1 0.25
#define NOOK_HORIZON_FAR_2 0.0378

// The coefficients of the bands of a cosine-weighted disc: A1 = 1 - s (c11 + s c12), A2 = 1 - s c21, A3 = (1
// - s)^(3/2), A4 = 1 - s (c41 - s c42).
#define NOOK_DISC_BAND_11 0.25
#define NOOK_DISC_BAND_12 0.0833333
#define NOOK_DISC_BAND_21 0.75
#define NOOK_DISC_BAND_41 2.5
#define NOOK_DISC_BAND_42 1.4583333

// In the table of casters, a body, a part of a body and a caster each take a fixed number of texels. In the
// lists of tiles, each tile has one texel, with the position and the number of its entries. An entry is the
// index of a body. Four entries are stored in a texel.
#define NOOK_BODY_TEXELS 4
#define NOOK_PART_TEXELS 4
#define NOOK_CASTER_TEXELS 2

// One float encodes two values of a body: strength / cut-off, and the radius. The integer part is strength /
// cut-off in steps of 1 / NOOK_STRENGTH_STEPS square metres. The fraction is the radius divided by
// NOOK_LARGEST_RADIUS, which is in metres. If a value of the body is too large for this, the body gets
// NOOK_ENDLESS_BOUND, which means that it reaches everything.
#define NOOK_STRENGTH_STEPS 8.0
#define NOOK_LARGEST_RADIUS 4.0
#define NOOK_LARGEST_STRENGTH 4096.0
#define NOOK_ENDLESS_BOUND 1e15

// The maximum number of parts of a body, and the threads of a group along x and y in compute shaders.
#define NOOK_MAX_PARTS 16
#define NOOK_WORLD_GROUP_SIZE 8

// Values of NOOK_BODIES, which selects the bodies that a stage evaluates: all bodies, near bodies or far
// bodies. Beyond its merging distance, a body is a far body, and one capsule replaces it. If the squared
// distance of a body is between NOOK_FAR_FROM and 1 times its squared merging distance, near and far results
// are blended.
#define NOOK_ALL_BODIES 0
#define NOOK_NEAR_BODIES 1
#define NOOK_FAR_BODIES 2
#define NOOK_FAR_FROM 0.6
// The size of a texel of the AO of far bodies, in pixels along each side, in a pass for the largest images. A
// pass for smaller images defines a smaller step.
#ifndef NOOK_FAR_STEP
#define NOOK_FAR_STEP 8
#endif

// The values of nook_world_view that show counts.
#define NOOK_VIEW_CASTERS 1
#define NOOK_VIEW_EXACT_CASTERS 2
#define NOOK_VIEW_TESTS 3
#define NOOK_VIEW_FAR_CASTERS 4
#define NOOK_VIEW_FAR_TESTS 5

// The coefficients of the share of a unit disc beyond a line, 0.5 + x (c1 + c3 x^2). c1 is -2 / pi, the slope
// at the middle.
#define NOOK_SEGMENT_1 -0.63662
#define NOOK_SEGMENT_3 0.13662
// The radius of the capsule in units of the part's radius. Up to this radius, a capsule is treated as a
// rectangle. From this radius plus 1 on, it is treated as a half-plane. In between, both results are blended.
#define NOOK_NARROW_RADIUS 0.75

// Number of equal parts of a cone of light.
#define NOOK_CONE_PARTS 16
// Sizes of the uniform arrays of light.glsl. That file describes the arrays.
#define NOOK_CONE_VEC4S 18
#define NOOK_LIGHT_TERMS 25
#define NOOK_LIGHT_VEC4S 26
// A body that shadows the cone of light has this many texels.
#define NOOK_SHADE_TEXELS 2

#endif
