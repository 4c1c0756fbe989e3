#include <nook/nook_gl_synthesis.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_gl_synthesis_info, 24);
NOOK_AT(nook_gl_synthesis_info, texture, 4);
NOOK_AT(nook_gl_synthesis_info, texture_bytes, 8);
NOOK_AT(nook_gl_synthesis_info, glsl, 16);
