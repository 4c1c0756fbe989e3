#include "shaders/world/host.glsl"
in vec3 albedo, ambient, direct, position_vs, normal_vs, irradiance_of_lobes, irradiance_of_sun;
uniform sampler2D world_texture;
flat in ivec2 pixel;
const float pi = 3.14159265;
out vec3 colour;
