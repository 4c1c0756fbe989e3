#include <nook/experimental/nook_synthesis.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_synthesis_info, 24);
NOOK_AT(nook_synthesis_info, side, 4);
NOOK_AT(nook_synthesis_info, material_width, 8);
NOOK_AT(nook_synthesis_info, material_height, 12);
NOOK_AT(nook_synthesis_info, texture_bytes, 16);
