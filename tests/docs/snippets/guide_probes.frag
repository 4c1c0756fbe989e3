#include "shaders/probe/host.glsl"
#include "shaders/character/host.glsl"
in vec3 position_ws, n, v, tangent, albedo, normal_ws;
in float roughness, ao;
out vec3 colour;
