#include <nook/nook_gl_probe.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_gl_probe_info, 24);
NOOK_AT(nook_gl_probe_info, struct_size, 0);
NOOK_AT(nook_gl_probe_info, texture, 4);
NOOK_AT(nook_gl_probe_info, bytes, 8);
NOOK_AT(nook_gl_probe_info, glsl, 16);

NOOK_SIZE(nook_gl_probe_grid_info, 96);
NOOK_AT(nook_gl_probe_grid_info, struct_size, 0);
NOOK_AT(nook_gl_probe_grid_info, texture, 4);
NOOK_AT(nook_gl_probe_grid_info, bytes, 8);
NOOK_AT(nook_gl_probe_grid_info, glsl, 16);
NOOK_AT(nook_gl_probe_grid_info, frame, 24);
NOOK_AT(nook_gl_probe_grid_info, walls, 88);
NOOK_AT(nook_gl_probe_grid_info, reserved, 92);
