// Constants that the shaders of the screen-space pass share with the C++ code: texture units, the layout of a
// frame's constants, and the layout of a network. C++ and GLSL both include this file.
#ifndef NOOK_NNAO_LAYOUT_H
#define NOOK_NNAO_LAYOUT_H

// Texture units. Two textures share a unit only if no stage reads both.
#define NOOK_UNIT_DEPTH 0
#define NOOK_UNIT_HOST_DEPTH 1
#define NOOK_UNIT_NORMAL 1
#define NOOK_UNIT_AO 2
#define NOOK_UNIT_FILTERS 2
#define NOOK_UNIT_LAYER 3
#define NOOK_UNIT_HISTORY_DEPTH 1
#define NOOK_UNIT_HISTORY 3
#define NOOK_UNIT_MOTION 4
#define NOOK_UNIT_COUNT 5
// For the network as a compute shader: the image unit, and the number of threads of a group along x and y.
#define NOOK_IMAGE_UNIT 0
#define NOOK_OCCLUSION_GROUP_SIZE 8

// Indices of the vec4 in the uniform array nook_frame.
#define NOOK_FRAME_SCREEN_RAYS 0
#define NOOK_FRAME_SURFACE_RAYS 1
#define NOOK_FRAME_DEPTH_DECODE 2
#define NOOK_FRAME_FAR 3
#define NOOK_FRAME_SPREAD 4
#define NOOK_FRAME_RADIUS 5
#define NOOK_FRAME_NORMAL 6
#define NOOK_FRAME_VIEWPORT 7
#define NOOK_FRAME_SURFACE 8
#define NOOK_FRAME_NORMAL_MATRIX 9
#define NOOK_FRAME_INPUT 12
#define NOOK_FRAME_FADE 13
#define NOOK_FRAME_VEC4S 14

// The uniform array nook_earlier starts with the three rows of the matrix to the earlier frame's view space.
// Then these vec4 follow.
#define NOOK_EARLIER_RAYS 3
#define NOOK_EARLIER_SIZE 4
#define NOOK_EARLIER_MOTION 5
#define NOOK_EARLIER_VEC4S 6

// The values of nook_nnao_sample.
#define NOOK_SAMPLE_MEDIAN 0
#define NOOK_SAMPLE_FIRST 1
#define NOOK_SAMPLE_NEAREST 2

// Values of nook_gbuffer_ao. In the modes from REPLACE on, the layer has a weight.
#define NOOK_LAYER_MIN 1
#define NOOK_LAYER_REPLACE 3
// If the weight of a layer is above these limits, there is no surface. The first limit is for layers whose
// pixels the screen-space pass excludes. The second is for layers that replace AO: above it, at most one
// 8-bit step of the surface's own AO would remain.
#define NOOK_EXCLUDED_ABOVE 0.5
#define NOOK_REPLACED_ABOVE 0.998

// What surface.frag counts for SurfaceWatch. SURFACE: pixels with a surface. UNMASKED: surfaces that the
// host's mask does not replace. FAR_ENOUGH: surfaces at which the radius is at most as large as the picture
// is high. NEAR_ENOUGH: surfaces at which the radius covers at least two pixels. REVERSED: surfaces that
// would be both if the stored depth were 1 minus the stored depth.
#define NOOK_WATCH_SURFACE 0
#define NOOK_WATCH_UNMASKED 1
#define NOOK_WATCH_FAR_ENOUGH 2
#define NOOK_WATCH_NEAR_ENOUGH 3
#define NOOK_WATCH_REVERSED 4
#define NOOK_WATCH_COUNT 5

// The noise of the taps repeats after this many pixels along each axis, and the filter averages over the same
// number of pixels.
#define NOOK_NOISE_SIZE 3
#define NOOK_NOISE_COUNT 9

// The paper's grid of taps has this many cells along a side.
#define NOOK_GRID_SIZE 31

// The horizon form of a network: the number of units of a layer, which are stored in one vec4, and the number
// of inputs of a tap.
#define NOOK_HORIZON_UNITS 4
#define NOOK_HORIZON_TAP_INPUTS 4
// The indices of the layers in nook_network, in vec4, in the order of network.h. A layer consists of one vec4
// of units for each input, one for each value of its gate, and one with the slopes. The tap layer has
// thresholds instead of slopes. The layer of the bent normal has two outputs and no slopes. Each of its vec4
// has four weights of one output, and the last vec4 has the gate weights of both outputs.
#define NOOK_HORIZON_TAP 0
#define NOOK_HORIZON_TAP_THRESHOLD NOOK_HORIZON_TAP_INPUTS
#define NOOK_HORIZON_DIRECTION (NOOK_HORIZON_TAP_THRESHOLD + 1)
#define NOOK_HORIZON_DIRECTION_GATE (NOOK_HORIZON_DIRECTION + 2 * NOOK_HORIZON_UNITS)
#define NOOK_HORIZON_DIRECTION_SLOPE (NOOK_HORIZON_DIRECTION_GATE + 2)
#define NOOK_HORIZON_JOIN (NOOK_HORIZON_DIRECTION_SLOPE + 1)
#define NOOK_HORIZON_JOIN_GATE (NOOK_HORIZON_JOIN + NOOK_HORIZON_UNITS)
#define NOOK_HORIZON_JOIN_SLOPE (NOOK_HORIZON_JOIN_GATE + 2)
#define NOOK_HORIZON_OUT (NOOK_HORIZON_JOIN_SLOPE + 1)
#define NOOK_HORIZON_BENT (NOOK_HORIZON_OUT + 1)
#define NOOK_HORIZON_BENT_GATE (NOOK_HORIZON_BENT + 4)
#define NOOK_HORIZON_VEC4S (NOOK_HORIZON_BENT_GATE + 1)
// For each direction, take the greatest product of elevation and nearness. The upper bound of 1 - AO is this
// factor times the mean of these products over all directions.
#define NOOK_HORIZON_BOUND 8.0

// The paper's form of a network has four units per layer. nook_network contains the bias and slopes of the
// filters, two layers with four inputs, and a layer with one unit.
#define NOOK_PAPER_UNITS 4
#define NOOK_PAPER_FILTERS 0
#define NOOK_PAPER_LAYER_VEC4S (NOOK_PAPER_UNITS + 3)
#define NOOK_PAPER_LAYER_1 3
#define NOOK_PAPER_LAYER_2 (NOOK_PAPER_LAYER_1 + NOOK_PAPER_LAYER_VEC4S)
#define NOOK_PAPER_LAYER_3 (NOOK_PAPER_LAYER_2 + NOOK_PAPER_LAYER_VEC4S)
#define NOOK_PAPER_VEC4S (NOOK_PAPER_LAYER_3 + 2)

#endif
