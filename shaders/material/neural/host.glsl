// The functions of a host's shader for a neural material. sdk/src/gl/material/neural_source.cpp writes the sizes, the
// weights as constants and the sampler of the features before this text.
#include "shaders/material/view_map.glsl"

#include "shaders/material/footprint.glsl"

#include "shaders/material/neural/decode.glsl"

#include "shaders/material/visibility.glsl"
