// Numbers that the stages of the screen-space pass share with the C++ that runs them: texture units, the
// constants of a frame, and the arrays of a network. C++ and GLSL both include this file.
#ifndef NOOK_NNAO_LAYOUT_H
#define NOOK_NNAO_LAYOUT_H

// Texture units. A stage never reads both textures of a shared unit.
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
// The image unit, and the threads of a group along x and y if the network runs as a compute shader.
#define NOOK_IMAGE_UNIT 0
#define NOOK_OCCLUSION_GROUP_SIZE 8

// vec4 of the uniform array nook_frame.
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

// The uniform array nook_earlier has the rows of the matrix to the earlier frame's view space, then these
// vec4.
#define NOOK_EARLIER_RAYS 3
#define NOOK_EARLIER_SIZE 4
#define NOOK_EARLIER_MOTION 5
#define NOOK_EARLIER_VEC4S 6

// The values of nook_nnao_sample.
#define NOOK_SAMPLE_MEDIAN 0
#define NOOK_SAMPLE_FIRST 1
#define NOOK_SAMPLE_NEAREST 2

// Values of nook_gbuffer_ao. From REPLACE on, the layer has a weight.
#define NOOK_LAYER_MIN 1
#define NOOK_LAYER_REPLACE 3
// Above these weights, depth has no surface. One is for layers that the screen-space pass excludes. The other
// is for layers that replace: at most one step of 8 bits of the surface is left.
#define NOOK_EXCLUDED_ABOVE 0.5
#define NOOK_REPLACED_ABOVE 0.998

// The noise of the taps repeats after this many pixels along each axis. The filter averages the same number
// of pixels.
#define NOOK_NOISE_SIZE 3
#define NOOK_NOISE_COUNT 9

// The paper's grid of taps has this many cells along a side.
#define NOOK_GRID_SIZE 31

// A network of the horizon form: units of a layer, which are one vec4, and inputs of a tap.
#define NOOK_HORIZON_UNITS 4
#define NOOK_HORIZON_TAP_INPUTS 4
// The layers in nook_network, as vec4, in the order of network.h. A layer is a row of units for each input,
// then for each value of its gate, then slopes. Taps have thresholds instead of slopes. The bent normal's
// layer has two outputs and no slopes: each vec4 is four weights of one output, and the last vec4 is both
// gates.
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
// 1 - AO is at most this many times the mean over the directions of the greatest elevation times nearness.
#define NOOK_HORIZON_BOUND 8.0

// A network of the paper's form has four units a layer: bias and slopes of the filters, two layers of four
// inputs, and one layer of one unit.
#define NOOK_PAPER_UNITS 4
#define NOOK_PAPER_FILTERS 0
#define NOOK_PAPER_LAYER_VEC4S (NOOK_PAPER_UNITS + 3)
#define NOOK_PAPER_LAYER_1 3
#define NOOK_PAPER_LAYER_2 (NOOK_PAPER_LAYER_1 + NOOK_PAPER_LAYER_VEC4S)
#define NOOK_PAPER_LAYER_3 (NOOK_PAPER_LAYER_2 + NOOK_PAPER_LAYER_VEC4S)
#define NOOK_PAPER_VEC4S (NOOK_PAPER_LAYER_3 + 2)

#endif
