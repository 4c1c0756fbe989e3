#include "shaders/world/host.glsl"
in vec3 albedo, ambient, direct, position_vs, normal_vs;
out vec3 colour;
