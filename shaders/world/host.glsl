// For a host's shaders, for example in a forward renderer:
//   float nook_world_open(vec3 point, vec3 normal)
// returns the AO of all casters at a point with a unit normal, both in the view space of the frame's matrix.
// Bind the pass's table of casters to nook_world_casters and set nook_world_groups; nook_world_describe
// returns both.
#include "shaders/world/casters.glsl"
