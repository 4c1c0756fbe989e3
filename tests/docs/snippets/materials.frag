#include "tests/docs/snippets/material.glsl"
in vec2 uv;
in vec3 view, light, irradiance;
out vec3 colour;
