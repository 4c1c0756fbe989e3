#include <nook/nook_gl.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_gl_desc, 40);
NOOK_AT(nook_gl_desc, struct_size, 0);
NOOK_AT(nook_gl_desc, header_version, 4);
NOOK_AT(nook_gl_desc, next, 8);
NOOK_AT(nook_gl_desc, get_proc, 16);
NOOK_AT(nook_gl_desc, get_proc_user, 24);
NOOK_AT(nook_gl_desc, max_tier, 32);
NOOK_AT(nook_gl_desc, state_mode, 36);

NOOK_SIZE(nook_gl_info, 40);
NOOK_AT(nook_gl_info, struct_size, 0);
NOOK_AT(nook_gl_info, tier, 4);
NOOK_AT(nook_gl_info, version, 8);
NOOK_AT(nook_gl_info, renderer, 16);
NOOK_AT(nook_gl_info, buffer_bytes, 24);
NOOK_AT(nook_gl_info, ao_bytes, 32);

NOOK_SIZE(nook_gl_ao_target, 40);
NOOK_AT(nook_gl_ao_target, struct_size, 0);
NOOK_AT(nook_gl_ao_target, format, 4);
NOOK_AT(nook_gl_ao_target, buffer, 8);
NOOK_AT(nook_gl_ao_target, texture, 12);
NOOK_AT(nook_gl_ao_target, offset, 16);
NOOK_AT(nook_gl_ao_target, instance_stride, 24);
NOOK_AT(nook_gl_ao_target, stride, 32);
NOOK_AT(nook_gl_ao_target, texture_width, 36);

NOOK_SIZE(nook_gl_ao_view, 24);
NOOK_AT(nook_gl_ao_view, struct_size, 0);
NOOK_AT(nook_gl_ao_view, buffer, 4);
NOOK_AT(nook_gl_ao_view, offset, 8);
NOOK_AT(nook_gl_ao_view, stride, 16);
NOOK_AT(nook_gl_ao_view, count, 20);

NOOK_SIZE(nook_gl_light_view, 40);
NOOK_AT(nook_gl_light_view, struct_size, 0);
NOOK_AT(nook_gl_light_view, buffer, 4);
NOOK_AT(nook_gl_light_view, offset, 8);
NOOK_AT(nook_gl_light_view, stride, 16);
NOOK_AT(nook_gl_light_view, count, 20);
NOOK_AT(nook_gl_light_view, texture, 24);
NOOK_AT(nook_gl_light_view, light, 28);
NOOK_AT(nook_gl_light_view, glsl, 32);

NOOK_SIZE(nook_gl_memory, 32);
NOOK_AT(nook_gl_memory, struct_size, 0);
NOOK_AT(nook_gl_memory, reserved, 4);
NOOK_AT(nook_gl_memory, model_bytes, 8);
NOOK_AT(nook_gl_memory, instance_bytes, 16);
NOOK_AT(nook_gl_memory, lit_instance_bytes, 24);
