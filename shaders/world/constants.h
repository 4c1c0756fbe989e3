// Constants of formulas in sdk/src/world (coverage.h, cone.h) and in these shaders; the headers describe
// them. C++ and GLSL both include this file.
#ifndef NOOK_WORLD_CONSTANTS_H
#define NOOK_WORLD_CONSTANTS_H

// The arc cosine within 7e-5: Abramowitz and Stegun 4.4.45.
#define NOOK_ARC_0 1.5707288
#define NOOK_ARC_1 -0.2121144
#define NOOK_ARC_2 0.0742610
#define NOOK_ARC_3 -0.0187293

// If the squared sine of the angle between a capsule's ends is below this, they count as one place.
#define NOOK_SMALLEST_SPREAD 1e-6
// The largest sine of an end's angular radius. It is just below 1, the sine on the surface.
#define NOOK_LARGEST_SINE 0.9999

// The share below the horizon, w1 (1 - t^2) + w2 (1 - t^2)^2 with w = b (c0 + b (c1 + b c2)).
#define NOOK_HORIZON_10 1.09177
#define NOOK_HORIZON_11 -1.52723
#define NOOK_HORIZON_12 0.68546
#define NOOK_HORIZON_20 -0.49913
#define NOOK_HORIZON_21 1.05297
#define NOOK_HORIZON_22 -0.51604

// w1 and w2 of a small disc, b = 1: sums of the above.
#define NOOK_HORIZON_FAR_1 0.25
#define NOOK_HORIZON_FAR_2 0.0378

// The bands of a cosine-weighted disc: A1 = 1 - s (c11 + s c12), A2 = 1 - s c21, A3 = (1 - s)^(3/2), A4 = 1 -
// s (c41 - s c42).
#define NOOK_DISC_BAND_11 0.25
#define NOOK_DISC_BAND_12 0.0833333
#define NOOK_DISC_BAND_21 0.75
#define NOOK_DISC_BAND_41 2.5
#define NOOK_DISC_BAND_42 1.4583333

// Texels that the table of casters has for a body, a part of it, and a caster. A tile's list has one texel
// for its first entry and their number; an entry is a body's number, four to a texel.
#define NOOK_BODY_TEXELS 4
#define NOOK_PART_TEXELS 4
#define NOOK_CASTER_TEXELS 2

// The strength of a body over the cut-off is counted in steps of the inverse of this, square metres. The
// fraction of the number is the body's radius in metres divided by the largest one. Bodies with larger
// numbers reach everything, and have the endless number.
#define NOOK_STRENGTH_STEPS 8.0
#define NOOK_LARGEST_RADIUS 4.0
#define NOOK_LARGEST_STRENGTH 4096.0
#define NOOK_ENDLESS_BOUND 1e15

// The maximum number of parts of a body, and the threads of a group along x and y in compute shaders.
#define NOOK_MAX_PARTS 16
#define NOOK_WORLD_GROUP_SIZE 8

// Which bodies a stage evaluates, NOOK_BODIES: all; the ones nearer than the distance from which one capsule
// stands for them; or the farther ones. From this share of the squared distance on, both are blended.
#define NOOK_ALL_BODIES 0
#define NOOK_NEAR_BODIES 1
#define NOOK_FAR_BODIES 2
#define NOOK_FAR_FROM 0.6
// Pixels along a side for each texel of the far bodies' AO in a pass of the largest images. A pass of smaller
// images defines less.
#ifndef NOOK_FAR_STEP
#define NOOK_FAR_STEP 8
#endif

// The values of nook_world_view that show numbers.
#define NOOK_VIEW_CASTERS 1
#define NOOK_VIEW_EXACT_CASTERS 2
#define NOOK_VIEW_TESTS 3
#define NOOK_VIEW_FAR_CASTERS 4
#define NOOK_VIEW_FAR_TESTS 5

// The share of a unit disc beyond a line, 0.5 + x (c1 + c3 x^2): c1 is -2 / pi, the slope at the middle.
#define NOOK_SEGMENT_1 -0.63662
#define NOOK_SEGMENT_3 0.13662
// Up to this radius, in radii of a part, a capsule counts as a rectangle; from 1 more on, by its round edge.
#define NOOK_NARROW_RADIUS 0.75

// The equal parts of a cone of light.
#define NOOK_CONE_PARTS 16
// Uniforms of light.glsl, which describes them.
#define NOOK_CONE_VEC4S 18
#define NOOK_LIGHT_TERMS 25
#define NOOK_LIGHT_VEC4S 26
// Texels of a body that casts the shadow of a cone.
#define NOOK_SHADE_TEXELS 2

#endif
