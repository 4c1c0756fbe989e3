#include <nook/nook_bake.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_bake_progress, 32);
NOOK_AT(nook_bake_progress, struct_size, 0);
NOOK_AT(nook_bake_progress, state, 4);
NOOK_AT(nook_bake_progress, stage, 8);
NOOK_AT(nook_bake_progress, done, 16);
NOOK_AT(nook_bake_progress, total, 24);
