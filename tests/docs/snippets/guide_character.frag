#include "shaders/clips/host.glsl"
#define gl_VertexID 0
in vec3 albedo, ambient, direct;
in float ao, others;
in vec3 normal, dark, open;
uniform mat3 skin;
uniform ivec2 frames;
uniform float share;
out vec3 colour;
float vertex_ao;
