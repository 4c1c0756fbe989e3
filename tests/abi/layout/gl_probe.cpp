#include <nook/nook_gl_probe.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_gl_probe_info, 24);
NOOK_AT(nook_gl_probe_info, struct_size, 0);
NOOK_AT(nook_gl_probe_info, texture, 4);
NOOK_AT(nook_gl_probe_info, bytes, 8);
NOOK_AT(nook_gl_probe_info, glsl, 16);
