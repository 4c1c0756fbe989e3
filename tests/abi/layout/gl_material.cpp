#include <nook/nook_gl_material.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_gl_material_desc, 24);
NOOK_AT(nook_gl_material_desc, struct_size, 0);
NOOK_AT(nook_gl_material_desc, header_version, 4);
NOOK_AT(nook_gl_material_desc, next, 8);
NOOK_AT(nook_gl_material_desc, max_layers, 16);
NOOK_AT(nook_gl_material_desc, reserved, 20);

NOOK_SIZE(nook_gl_material_info, 24);
NOOK_AT(nook_gl_material_info, texture_count, 4);
NOOK_AT(nook_gl_material_info, texture_bytes, 8);
NOOK_AT(nook_gl_material_info, glsl, 16);

NOOK_SIZE(nook_gl_material_texture, 24);
NOOK_AT(nook_gl_material_texture, target, 4);
NOOK_AT(nook_gl_material_texture, texture, 8);
NOOK_AT(nook_gl_material_texture, uniform, 16);
