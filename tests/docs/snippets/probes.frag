#include "shaders/probe/host.glsl"
#include "shaders/character/host.glsl"
#define NOOK_GRID_TEXELS NOOK_GRID_ZONAL_TEXELS
#include "shaders/probe/volume/host.glsl"
in vec3 position_ws, n, v, tangent, albedo, normal_ws;
in float roughness, ao;
out vec3 colour;
