// For a host's shaders, for example in a forward renderer:
//   float nook_world_open(vec3 point, vec3 normal)
// returns the AO that all casters cause at a point. Pass the point and its unit normal in the view space of
// the frame's matrix. Bind the pass's table of casters to nook_world_casters, and set nook_world_groups.
// nook_world_describe returns the values for both.
#include "shaders/world/casters.glsl"
