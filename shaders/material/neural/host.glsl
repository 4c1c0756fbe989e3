// The functions of a host's shader for a neural material. Before this text,
// sdk/src/gl/material/material_glsl.cpp writes the sizes, the weights as constants and the sampler of the
// features, then base/host.glsl and the VOTF.
#include "shaders/material/neural/decode.glsl"

#include "shaders/material/visibility.glsl"
