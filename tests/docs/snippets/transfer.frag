#include "tests/docs/snippets/material.glsl"
#include "shaders/transfer/host.glsl"
in vec2 uv;
in vec3 view, normal;
in vec4 tangent;
in vec4 vectors[3 * NOOK_LIGHT_VEC4_COUNT];
out vec3 colour;
