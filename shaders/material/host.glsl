// Functions for a host's shader. Before this text, sdk/src/gl/material/material_glsl.cpp writes constants and
// samplers that depend on the sizes of the material, and base/host.glsl. For the BTF and for the VOTF, it also
// writes the function
//   vec4 nook_btf_mode(int cluster, int mode, vec2 uv, float level)
// and tensor/host.glsl. sdk/src/material/tables.h defines the layout of the textures, and
// sdk/src/material/reflectance.cpp has the same functions.
#include "shaders/material/btf.glsl"

#include "shaders/material/visibility.glsl"
