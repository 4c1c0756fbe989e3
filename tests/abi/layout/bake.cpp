#include <nook/nook_bake.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_bake_progress, 24);
NOOK_AT(nook_bake_progress, struct_size, 0);
NOOK_AT(nook_bake_progress, stage, 4);
NOOK_AT(nook_bake_progress, done, 8);
NOOK_AT(nook_bake_progress, total, 16);
