// Functions for a host's shader that uses a neural material. Before this text,
// sdk/src/gl/material/material_glsl.cpp writes the sizes, the weights as constants, the sampler of the
// features, base/host.glsl and the VOTF.
#include "shaders/material/neural/decode.glsl"

#include "shaders/material/visibility.glsl"
