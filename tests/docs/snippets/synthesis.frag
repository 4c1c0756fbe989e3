#include "tests/docs/snippets/material.glsl"
#define NOOK_SYNTHESIS_SIDE 512.0
#define NOOK_SYNTHESIS_MATERIAL_TEXELS vec2(96.0, 96.0)
#include "shaders/synthesis/host.glsl"
in vec2 uv;
in vec3 view;
