// For shaders of a host, such as those of a forward renderer:
//   float nook_world_open(vec3 point, vec3 normal)
// is the AO that all casters leave at a point with a unit normal, both in the view space of the frame's matrix.
// The host binds the pass's table of casters to nook_world_casters and sets nook_world_groups;
// nook_world_describe gives both.
#include "shaders/world/casters.glsl"
