#include <nook/experimental/nook_transfer.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_gl_transfer_info, 32);
NOOK_AT(nook_gl_transfer_info, texture, 4);
NOOK_AT(nook_gl_transfer_info, bytes, 8);
NOOK_AT(nook_gl_transfer_info, glsl, 16);
NOOK_AT(nook_gl_transfer_info, form, 24);
NOOK_AT(nook_gl_transfer_info, vertex_texture, 28);
