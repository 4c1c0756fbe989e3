#include "shaders/nnao/host.glsl"
uniform sampler2D nook_ao;
in vec3 albedo, ambient, direct, reflection, normal, to_viewer;
in float roughness;
out vec3 colour;
vec3 irradiance(vec3 direction);
