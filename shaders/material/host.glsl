// The functions of a host's shader. sdk/src/gl/material/source.cpp writes the constants, the samplers and the
// functions
//   vec4 nook_btf_mode(int cluster, int mode, vec2 uv, float level)
//   vec4 nook_votf_mode(int cluster, int mode, vec2 uv, float level)
// before this text, for the sizes of a material. sdk/src/material/tables.h defines the layout of layers and
// numbers, and sdk/src/material/evaluate.cpp has the same functions.
#include "shaders/material/view_map.glsl"

#include "shaders/material/footprint.glsl"

#include "shaders/material/btf.glsl"

#include "shaders/material/visibility.glsl"
